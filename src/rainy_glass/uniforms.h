// Uniform blocks of the passes of rainy_glass, and the records of the bakes. Sizes are multiples of 16 bytes, no member crosses a 16-byte
// row, and every gap is a named padding member, so the bytes are valid in every GPU language.
#pragma once

#include <cstdint>

namespace rainref::rainy_glass {

/// A droplet of the raindrop map. Lengths are in tiles. q = (m00 dx + m01 dy, m01 dx + m11 dy) has length 1 at its rim, which lies within
/// `radius` of its centre.
struct Droplet {
  float x, y;  ///< centre: multiples of 2^-16, so that differences to texel centres of a power-of-two map are exact
  float radius;
  float height;  ///< at the centre, relative to 1: proportional to the radius
  float m00, m01, m11, offset;
};

/// A rivulet: a head, and above it a tail that winds. Lengths are in tiles.
struct Trail {
  float x, y;  ///< centre of the head; multiples of 2^-16
  float half_width;
  float inverse_length;  ///< of the tail, which is at most 0.8 long
  float height, wiggle, wiggle_rate, wiggle_phase;
};

struct BakeRaindropsUniforms {
  float inverse_size[2];
  std::int32_t droplet_count;
  float normal_scale;
  float neutral, span;  ///< stored normal = neutral + span n
  float padding0, padding1;
};
struct BakeRivuletsUniforms {
  float inverse_size[2];
  std::int32_t trail_count;
  float normal_scale;
  float neutral, span;
  std::int32_t flow_cells;
  float flow_gain;  ///< stored flow = neutral + span clamp(flow_gain noise, -1, 1)
};

struct RainOnGlassUniforms {
  float pixel[2], time, rain_amount;
  float drop_tiles, rivulet_tiles, drop_rate, flow_rate;
  float flow_strength, distortion;
  std::int32_t use_probe;
  float probe_level;
  float drop_phase, flow_phase, scroll, run_strength;
  float drop_neutral, drop_scale, rivulet_neutral, rivulet_scale;
  float sharpness, impact, bend, rivulet_amount;
  float rain_to[3], padding0;
  float right[3], half_width;
  float up[3], half_height;
  float forward[3], padding1;
  float turn[2], rivulet_turn[2];
  float flow_from[2], flow_span[2];
  float tint[3], fade_rate;
  std::int32_t remap_first, signed_offset, squared_weight;
  float padding2;
};

static_assert(sizeof(Droplet) == 32 && sizeof(Trail) == 32 && sizeof(BakeRaindropsUniforms) == 32 && sizeof(BakeRivuletsUniforms) == 32);
static_assert(sizeof(RainOnGlassUniforms) == 224);

}  // namespace rainref::rainy_glass
