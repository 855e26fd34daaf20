// Texture lookups by the SIMD target in use and by the scalar evaluation, for comparison.
#pragma once

#include <cstddef>

#include "image/texture.h"

namespace rainref::test {

enum class Lookup {
  nearest,
  bilinear,
  bilinear_of_level_1,
  trilinear,
  mip,
  middle_channels,
  latlong,
  latlong_mip,
  cube,
  // Of textures whose rules and channels are fixed, as the kernels of passes take them.
  clamped,     ///< one channel, clamp
  bordered,    ///< one channel, border
  neighbours,  ///< one channel, clamp: left, right, down, up
  pair,        ///< two channels, repeat, mip
  colour       ///< four channels, repeat, trilinear
};

/// Coordinates u and v, or a direction (u, v, w); lod where the lookup has one.
struct Place {
  float u, v, w, lod;
};
/// Channels that the lookup does not give are zero.
struct Texel {
  float c[4];
};

/// out[i] = lookup at place i. The count is a multiple of 16.
void look_up_by_lanes(Lookup lookup, const Texture& texture, const Place* places, Texel* out, std::size_t count);
Texel look_up_by_plain(Lookup lookup, const Texture& texture, const Place& place);

}  // namespace rainref::test
