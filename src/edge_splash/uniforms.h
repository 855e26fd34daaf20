// Uniform blocks of the passes of edge_splash. Sizes are multiples of 16 bytes, no member crosses a 16-byte row, and every gap is a named
// padding member, so the bytes are valid in every GPU language.
#pragma once

#include <cstdint>

namespace rainref::edge_splash {

/// splash, as published: the article's constant buffer.
struct PublishedSplashUniforms {
  float drop_color[4];
  std::int32_t width, height, noise_width, noise_height;
  float edge_threshold, rain_drop_scale, time, drop_speed;
  std::int32_t thickness, padding0, padding1, padding2;
};

/// splash, corrected. Thresholds come in pairs, 0 below the first and 1 above the second.
struct SplashUniforms {
  float drop_color[4];
  float up[3], reach;
  float pixel[2], half_size[2];
  float depth_scale, depth_bias, reach_min, reach_max;
  float step_low, step_high, bend_low, bend_high;
  float cosine_low, cosine_high, noise_low, noise_high;
  float noise_scale[2], noise_offset[2];
};

static_assert(sizeof(PublishedSplashUniforms) == 64 && sizeof(SplashUniforms) == 112);

}  // namespace rainref::edge_splash
