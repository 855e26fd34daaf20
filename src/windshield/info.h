// The description of the windshield.
#pragma once

#include <memory>
#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"

namespace rainref::windshield {

/// Passes, buffers and GPU layouts of the windshield.
const capture::EffectInfo& effect_info();

/// Evaluations of every pass of both variants that is not taken as data.
const std::vector<capture::PassEvaluations>& evaluations();

std::unique_ptr<capture::PassModel> bind_windshield_frame(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_wipe_drops(const capture::PassCase& c);

/// corrected: blade ends from `inner` and `outer`, coordinates on the glass, instead of pivot, axis and radii. as-published: ends from
/// these instead of those.
std::unique_ptr<capture::PassModel> bind_wipe_from_ends(const capture::PassCase& c);

}  // namespace rainref::windshield
