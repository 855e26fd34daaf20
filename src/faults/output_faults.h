// Mistakes in what happens to a finished buffer: orientation, channel order, encoding, timing.
#pragma once

#include "faults/fault.h"

namespace rainref::faults {

/// Adds those that can happen to the case's images. `before`: the run of the same pass before, or null.
void add_output_faults(std::vector<Fault>& out, const capture::PassCase& c, const capture::PassCase* before);

}  // namespace rainref::faults
