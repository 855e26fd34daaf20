// What the passes of edge_splash take besides images. Sizes are multiples of 16 bytes, nothing straddles a 16-byte row, and
// every gap is a named padding member, so the bytes serve every GPU language.
#pragma once

#include <cstdint>

namespace rainref::edge_splash {

/// splash, as published: the article's constant buffer.
struct PublishedSplashUniforms {
  float drop_color[4];                     ///< linear RGB, opacity
  std::int32_t width, height;              ///< of the picture [texel]
  std::int32_t noise_width, noise_height;  ///< [texel]
  float edge_threshold;                    ///< of the Sobel sum of device depths
  float rain_drop_scale;                   ///< threshold of the noise
  float time;                              ///< n / fps, rounded once [s]
  float drop_speed;                        ///< of the noise, in x and in y [texel/s]
  std::int32_t thickness;                  ///< distance of the taps where the depth is 1 [texel]
  std::int32_t padding0, padding1, padding2;
};

/// splash, corrected. Thresholds come in pairs, 0 below the first and 1 above the second.
struct SplashUniforms {
  float drop_color[4];            ///< linear RGB, opacity
  float up[3];                    ///< unit vector that points up, in camera axes: right, up, forward
  float reach;                    ///< texels that the band covers at 1 m
  float pixel[2];                 ///< extent of a pixel on the image plane at distance 1
  float half_size[2];             ///< half the extent of the image plane at distance 1
  float depth_scale, depth_bias;  ///< 1 / z = depth_scale d + depth_bias [1/m]
  float reach_min, reach_max;     ///< bounds of the reach [texel]
  float step_low, step_high;      ///< of the Sobel sum of distances [m]
  float bend_low, bend_high;      ///< of the bend, see splash.pass.h
  float cosine_low, cosine_high;  ///< of the cosine between an edge's normal and up
  float noise_low, noise_high;    ///< of the noise
  float noise_scale[2];           ///< texture coordinates of the noise in a pixel
  float noise_offset[2];          ///< scrolled so far, in [0, 1)
};

static_assert(sizeof(PublishedSplashUniforms) == 64 && sizeof(SplashUniforms) == 112);

}  // namespace rainref::edge_splash
