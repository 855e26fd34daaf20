// Pictures as the puddle's passes take them, and what the host computes from them once.
#pragma once

#include <array>

#include "image/texture.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// The environment for shade: as-published display-encoded (a linear picture is encoded by the power 1/2.2, which the
/// pass undoes), corrected linear with mips. Cube faces that lie in a row are put into a column.
TextureData prepare_environment(const Surroundings& surroundings, Variant variant, const Rows& rows = rows_here);
/// The ground tile, likewise; corrected with mips.
TextureData prepare_ground(const Image& ground, bool is_encoded, Variant variant, const Rows& rows = rows_here);

/// Radiance of a white diffuse level ground under the environment: (1/pi) integral of L cos(theta) over the upper
/// half of directions.
std::array<float, 3> ambient_radiance(const Texture& environment, bool is_cube);

}  // namespace rainref::puddle
