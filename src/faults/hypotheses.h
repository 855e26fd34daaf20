// All that the diagnosis of a failing run tries.
#pragma once

#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// In the order in which they are to be believed: what is plain before what is fitted. `port`, `reference`: stored outputs, in
/// the order of the case's; `failing`: some texels that fail, at least one.
std::vector<Fault> hypotheses(const Probed& p, const capture::PassCase* before, const std::vector<capture::Array>& port,
                              const std::vector<capture::Array>& reference, const std::vector<Texel>& failing);

}  // namespace rainref::faults
