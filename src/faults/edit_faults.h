// An operation of the pass text whose parts are put together otherwise: exchanged, grouped or mapped otherwise, another curve.
#pragma once

#include <cstddef>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// Adds them for what the probes met, at most so many. `known`: as they were made with. `copies`: one part in the place of another,
/// too, which the search of what stands there finds better where it can be asked. `all`: more invocations, of other ways through the
/// pass, in which functions are called with other arguments.
void add_edit_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most,
                     bool copies, const std::vector<Probe>& all);

}  // namespace rainref::faults
