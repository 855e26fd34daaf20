// The passes of rainy_glass as conformance takes them.
#pragma once

#include <vector>

#include "capture/pass_model.h"

namespace rainref::rainy_glass {

/// Every pass, of both variants, by envelope.
const std::vector<capture::PassEvaluations>& evaluations();

}  // namespace rainref::rainy_glass
