// Mistakes in the order of steps: a value of before in place of the new one, a factor that is applied too early or too late.
#pragma once

#include <cstddef>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// Adds them for what the probes met, at most so many. `known`: as they were made with.
void add_order_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most = 600);

}  // namespace rainref::faults
