// Measures whether an image tiles.
#pragma once

#include "rainref/image.h"

namespace rainref {

/// The mean step of an image's channels across opposite edges over the mean step between neighbours inside. About 1 for a tile, 0 for a
/// constant and for sides below 3.
double seam_ratio(const Image& tile);
/// An image with a larger ratio does not tile.
inline constexpr double worst_seam_ratio = 4;

}  // namespace rainref
