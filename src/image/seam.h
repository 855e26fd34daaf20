// Whether an image tiles.
#pragma once

#include "rainref/image.h"

namespace rainref {

/// How badly an image's opposite edges disagree: the mean step of its channels across the edges over that between neighbours inside; about
/// 1 for a tile, 0 for a constant and for sides below 3.
double seam_ratio(const Image& tile);
/// Above this it does not tile.
inline constexpr double worst_seam_ratio = 4;

}  // namespace rainref
