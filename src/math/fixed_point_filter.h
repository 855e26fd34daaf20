// The filter of NVIDIA's H100 and H200, found by sweeps of small textures and from outputs of ports (docs/notes/devices.md, "What an H100's
// sampler does"). tests/image/h100_filter_test.cpp checks it against separate formulas.
//
//   coordinate  the fraction of u after the address rule is cut to 21 bits, u size - 1/2 then rounded to 1/256, half up
//   level       cut to 1/256
//   weights     in steps of 1/256: the level's share s of 256, X = s fx half up, the right column's X fy half up and the left column's
//               (s - X) fy half down, the rest below them
//   result      the sum of all weighted texels, of both levels, rounded to the texels' halves once, half away from zero
//
// The error of each rounding is at most 2^-8, and one unit of the texels' format, which every profile with an 8-bit sampler allows.
#pragma once

#include <cstdint>

#include "math/floor_of.h"
#include "math/half.h"

namespace rainref::fixed_point {

inline constexpr int bits = 8;  ///< for the fraction of a coordinate, of a level and of a weight

/// u size - 1/2 of a filtered lookup within [low, high], with u after the address rule. If the result differs by more than a step from
/// `in_float`, the arithmetic result, `in_float` is used.
inline float texel_coordinate(float u, float size, float in_float, float low, float high) {
  const double cut = floor_of(static_cast<double>(u) * 0x1p21) * 0x1p-21;
  const double x = floor_of((cut * static_cast<double>(size) - 0.5) * 256 + 0.5) / 256, off = x - static_cast<double>(in_float);
  if (off < -0x1p-8 || off > 0x1p-8) return in_float;
  const float near = static_cast<float>(x);
  return near < low ? low : near > high ? high : near;
}
inline float level(float lod) { return static_cast<float>(floor_of(static_cast<double>(lod) * 256) / 256); }

/// The weighted sum of texels a, b of one row and c, d of the next; fx, fy and the level's share are in steps of 1/256.
inline float weighted(float a, float b, float c, float d, float fx, float fy, float share) {
  const double whole = 256 * static_cast<double>(share), y = fy;
  const double right = floor_of(whole * static_cast<double>(fx) + 0.5), left = whole - right;
  const double right_above = floor_of(right * y + 0.5), left_above = -floor_of(0.5 - left * y);
  return static_cast<float>(((left - left_above) * a + (right - right_above) * b + left_above * c + right_above * d) / 256);
}
/// The result of the sampler, for texels that are halves.
inline float to_nearest_half(float x) {
  const Half cut = to_half(x, Rounding::rtz);
  const float near = to_float(cut), far = to_float(Half{static_cast<std::uint16_t>(cut.bits + 1)});
  const bool is_nearer = x < 0 ? x - far <= near - x : far - x <= x - near;  // never true for an infinity
  return is_nearer ? far : near;
}

}  // namespace rainref::fixed_point
