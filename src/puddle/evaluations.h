// The puddle's passes as conformance takes them.
#pragma once

#include <vector>

#include "capture/pass_model.h"

namespace rainref::puddle {

/// wave_step, surface_hit, shade and display, of both variants, and raindrops, corrected, which is compared by bits.
/// raindrops as published and ground_noise are taken as data.
const std::vector<capture::PassEvaluations>& evaluations();

/// surface_hit is judged by the gap between its hit and the water: see surface_hit_model.cpp.
std::unique_ptr<capture::PassModel> bind_surface_hit(const capture::PassCase& c);

}  // namespace rainref::puddle
