// The description of screen_drops.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"

namespace rainref::screen_drops {

/// Passes, buffers and GPU layouts of screen_drops.
const capture::EffectInfo& effect_info();

/// One entry for each pass.
const std::vector<capture::PassEvaluations>& evaluations();

}  // namespace rainref::screen_drops
