// The description of edge_splash.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"

namespace rainref::edge_splash {

/// Passes, buffers and GPU layouts of edge_splash.
const capture::EffectInfo& effect_info();

/// Evaluations of splash and display, of both variants.
const std::vector<capture::PassEvaluations>& evaluations();

}  // namespace rainref::edge_splash
