// screen_drops as conformance judges it: each pass bound to a captured case.
#pragma once

#include <vector>

#include "capture/pass_model.h"

namespace rainref::screen_drops {

/// One entry for each pass.
const std::vector<capture::PassEvaluations>& evaluations();

}  // namespace rainref::screen_drops
