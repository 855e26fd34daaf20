// The description of rainy_glass.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"

namespace rainref::rainy_glass {

/// Passes, buffers and GPU layouts of rainy_glass.
const capture::EffectInfo& effect_info();

/// Evaluations of every pass, of both variants, by envelope.
const std::vector<capture::PassEvaluations>& evaluations();

}  // namespace rainref::rainy_glass
