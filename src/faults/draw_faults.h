// Mistakes in passes of whole numbers: what is taken of a random word.
#pragma once

#include <functional>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

/// What `run` draws random words for.
std::vector<random::Purpose> purposes_drawn(const std::function<void()>& run);
/// Adds what can be taken of the wrong word or counter, of all blocks and, where there are several, of those of each purpose.
void add_draw_faults(std::vector<Fault>& out, const std::vector<random::Purpose>& drawn = {});
/// Counters to which a whole number of the uniforms is not added, or is though it should not be.
void add_counter_faults(std::vector<Fault>& out, const capture::PackPass& pass, const capture::PassCase& c);

}  // namespace rainref::faults
