// Pictures of the scene from files, as the passes take them.
#pragma once

#include "rainref/image.h"

namespace rainref::windshield {

/// Linear radiance as rgba16f, alpha 1, of a picture of 1 to 4 channels; negative values become 0, those beyond the
/// range of a half its largest value. is_encoded: the picture holds sRGB code values.
Image linear_half(const Image& picture, bool is_encoded);
/// Depth [m] as r32f from the first channel; below 0 becomes 0.
Image depth_of(const Image& picture);
/// As far as the street's sky everywhere.
Image far_depth(int width, int height);

}  // namespace rainref::windshield
