// The checkerboard under the water, for the pass and for the traced ground.
#pragma once

namespace rainref::puddle {

/// Colours of its tiles, linear RGB; the tile at the origin is dark.
constexpr double checkerboard_dark[3] = {0.15, 0.12, 0.10}, checkerboard_light[3] = {0.25, 0.22, 0.20};

}  // namespace rainref::puddle
