// Mistakes in passes of whole numbers: what is taken of a random word.
#pragma once

#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

void add_draw_faults(std::vector<Fault>& out);

}  // namespace rainref::faults
