// Pictures of the scene from files, as the passes take them.
#pragma once

#include "rainref/image.h"

namespace rainref::windshield {

/// Of linear radiance, rgba32f, as rgba16f, alpha 1; negative values become 0, those beyond the range of a half its largest
/// value.
Image opaque_half(const Image& linear);
/// As far as the street's sky everywhere.
Image far_depth(int width, int height);

}  // namespace rainref::windshield
