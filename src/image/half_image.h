// Pictures as halves.
#pragma once

#include <limits>

#include "base/rows.h"
#include "rainref/image.h"

namespace rainref {

/// Decoded, clamped to [least, most], rounded to nearest: rgba16f from an image of four channels. No value may be NaN. `rows` runs the
/// work.
Image as_half(const Image& image, const Rows& rows = rows_here, float least = -std::numeric_limits<float>::infinity(),
              float most = std::numeric_limits<float>::infinity());

}  // namespace rainref
