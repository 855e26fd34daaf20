// Mistakes in integer passes: the wrong bits of a random word.
#pragma once

#include <functional>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

/// Returns the purposes for which `run` draws random words.
std::vector<random::Purpose> purposes_drawn(const std::function<void()>& run);
/// Adds draws from the wrong word or counter: for all blocks, and for the blocks of each purpose if there are several.
void add_draw_faults(std::vector<Fault>& out, const std::vector<random::Purpose>& drawn = {});
/// Adds counters that miss an integer uniform, or that add one wrongly.
void add_counter_faults(std::vector<Fault>& out, const capture::PackPass& pass, const capture::PassCase& c);

}  // namespace rainref::faults
