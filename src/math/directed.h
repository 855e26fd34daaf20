// Outward rounding by bits: the neighbours of a float, and the bounds of a rounded result.
//
// Requires the floating-point state of the determinism contract: round to nearest, no flush to zero.
#pragma once

#include <bit>
#include <cstdint>

namespace rainref::enclosed {

inline constexpr float infinity = __builtin_inff();
inline constexpr float largest_finite = 0x1.fffffep127f;
inline constexpr float smallest_normal = 0x1p-126f;

/// The smallest float above x; x is not NaN and not +infinity.
inline float next_up(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f);  // -0 is +0
  return std::bit_cast<float>(x < 0 ? bits - 1 : bits + 1);
}
inline float next_down(float x) { return -next_up(-x); }

/// x or next_down(x), without a branch, because both are equally likely and the processor would mispredict half of the time.
inline float down_if(float x, bool is_down) {
  const auto bits = std::bit_cast<std::uint32_t>(x), step = static_cast<std::uint32_t>(is_down);
  const std::uint32_t moved = bits + step * (2 * (bits >> 31) - 1);
  return std::bit_cast<float>(bits == 0 ? step * 0x80000001u : moved);
}

/// The largest float that is not above x, and the smallest that is not below it.
inline float float_below(double x) {
  const float f = static_cast<float>(x);
  return down_if(f, static_cast<double>(f) > x);
}
inline float float_above(double x) { return -float_below(-x); }

/// a + b rounded down and up, from the nearest float and its exact error (Knuth, The Art of Computer Programming, 4.2.2).
inline float sum_error(float a, float b, float sum) {
  const float part = sum - a;
  return (a - (sum - part)) + (b - part);
}
inline float sum_below(float a, float b) {
  const float sum = a + b;
  return down_if(sum, sum_error(a, b, sum) < 0);
}
inline float sum_above(float a, float b) { return -sum_below(-a, -b); }

/// a + b in double, made odd if it is inexact: it then rounds to float as the exact sum would (Boldo and Melquiond, Emulation of FMA,
/// 2008).
inline double odd_sum(double a, double b) {
  const double s = a + b, t = s - a, error = (a - (s - t)) + (b - t);
  auto bits = std::bit_cast<std::uint64_t>(s);
  const std::uint64_t step = static_cast<std::uint64_t>(error != 0) & ~bits & 1, is_outward = (error > 0) == (s > 0);
  bits += step * (2 * is_outward - 1);  // without a branch, because both are equally likely
  return std::bit_cast<double>(bits);
}
/// a b + c, rounded once.
inline float fused_sum(float a, float b, float c) { return static_cast<float>(odd_sum(static_cast<double>(a) * b, c)); }

/// The gap between the floats around y; the larger gap at a power of two, 0 at 0.
inline double ulp_of(double y) {
  if (y == 0) return 0;
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(y) >> 52 & 0x7ff) - 1023;
  return std::bit_cast<double>(static_cast<std::uint64_t>((exponent < -126 ? -126 : exponent) - 23 + 1023) << 52);
}

}  // namespace rainref::enclosed
