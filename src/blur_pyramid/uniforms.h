// Uniform block of the pass blur_pyramid. The size is a multiple of 16 bytes and no member crosses a 16-byte row, so the bytes are valid in
// every GPU language.
#pragma once

#include <cstdint>

namespace rainref::blur_pyramid {

/// For a run of one level: level 0 fogs the scene, the others halve the level above.
struct BlurUniforms {
  float fog_colour[3], fog_density;
  // corrected: an output texel (x, y) is t0 + w1 (t1 - t0) + w2 (t2 - t0) of three input texels a side, from 2 x on, with
  // w1 = middle and w2 = last (x + 1).
  float middle[2], last[2];
  std::int32_t source_size[2], level, padding0;
};

static_assert(sizeof(BlurUniforms) == 48);

}  // namespace rainref::blur_pyramid
