// wipe_texture with the blades' ends from the other members of their records: each record holds them twice.
#pragma once

#include <memory>

#include "capture/pass_model.h"

namespace rainref::windshield {

/// corrected: ends from `inner` and `outer`, coordinates of the glass, in place of pivot, axis and radii. as-published: ends from these in
/// place of those.
std::unique_ptr<capture::PassModel> bind_wipe_from_ends(const capture::PassCase& c);

}  // namespace rainref::windshield
