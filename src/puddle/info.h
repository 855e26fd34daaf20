// The description of the puddle.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"

namespace rainref::puddle {

/// Passes, buffers and GPU layouts of the puddle.
const capture::EffectInfo& effect_info();

/// Evaluations of all passes, of both variants; corrected raindrops is compared by bits. ground_noise is taken as data, and is
/// evaluated only for a port that computes it in the shader of shade.
const std::vector<capture::PassEvaluations>& evaluations();

/// raindrops as published: record i is drop i.
std::unique_ptr<capture::PassModel> bind_raindrops(const capture::PassCase& c);

/// surface_hit is judged by the gap between its hit and the water: see evaluations_surface_hit.cpp.
std::unique_ptr<capture::PassModel> bind_surface_hit(const capture::PassCase& c);

}  // namespace rainref::puddle
