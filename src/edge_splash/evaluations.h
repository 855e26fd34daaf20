// The passes of edge_splash as conformance takes them.
#pragma once

#include <vector>

#include "capture/pass_model.h"

namespace rainref::edge_splash {

/// splash and display, of both variants.
const std::vector<capture::PassEvaluations>& evaluations();

}  // namespace rainref::edge_splash
