// What the floats of drops and of a glass's frame ordinarily are: how wide a bound of them may be and still say something.
#pragma once

#include <vector>

#include "capture/keyed_model.h"

namespace rainref::drops {

/// Of the members of Drop, in their units.
const std::vector<capture::FieldRange>& drop_ranges(bool corrected);
/// Of the members of GlassFrame.
const std::vector<capture::FieldRange>& frame_ranges();

}  // namespace rainref::drops
