// The scalar evaluation of double arithmetic, and the transcendental functions of one float.
//
// The formulas are in transcendental-inl.h, once, as text for a number type R. With Real64 they are scalar C++; with Real64Lanes
// (real64_lanes-inl.h) they are SIMD. Both give the same bits, because R has only operations that IEEE 754 rounds correctly, comparisons,
// selection and integer operations on the bits.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/floating_point.h"
#include "math/coefficients.h"
#include "math/large_angle.h"

namespace rainref {

/// Results above the range of float, and infinite results, become this number with their sign.
inline constexpr double largest_float = 0x1.fffffep127;

/// A whole number k with |k| < 2^51 is represented as whole_bias + k. Adding the bias to any double below 2^51 rounds it to the nearest
/// whole number, ties to even, and leaves k in the low bits, in two's complement.
inline constexpr double whole_bias = 0x1.8p52;

/// One double. Real64Lanes has the same interface, documented here.
struct Real64 {
  using Mask = bool;

  double v;

  Real64(double x) : v(x) {}

  friend Real64 operator+(Real64 a, Real64 b) { return a.v + b.v; }
  friend Real64 operator-(Real64 a, Real64 b) { return a.v - b.v; }
  friend Real64 operator*(Real64 a, Real64 b) { return a.v * b.v; }
  friend Real64 operator/(Real64 a, Real64 b) { return a.v / b.v; }
  friend Real64 operator-(Real64 a) { return -a.v; }
  friend Mask operator<(Real64 a, Real64 b) { return a.v < b.v; }
  friend Mask operator<=(Real64 a, Real64 b) { return a.v <= b.v; }
  friend Mask operator>(Real64 a, Real64 b) { return a.v > b.v; }
  friend Mask operator>=(Real64 a, Real64 b) { return a.v >= b.v; }
  friend Real64 select(Mask m, Real64 a, Real64 b) { return m ? a : b; }
  /// True if the mask is set in some lane. Use it only to skip work, never to choose a value.
  static bool any(Mask m) { return m; }

  /// Clears the sign bit.
  friend Real64 abs(Real64 a) { return from_bits(a.bits() & ~sign_bit); }
  /// True if the sign bit is set, also for -0.
  friend Mask has_sign_bit(Real64 a) { return (a.bits() & sign_bit) != 0; }
  /// a, negated if the sign bit of s is set.
  friend Real64 flip_sign(Real64 a, Real64 s) { return from_bits(a.bits() ^ (s.bits() & sign_bit)); }

  /// For a whole number k represented as whole_bias + k: whether k is odd.
  friend Mask is_odd(Real64 biased) { return (biased.bits() & 1) != 0; }
  /// a, negated if k modulo 4 is 2 or 3.
  friend Real64 flip_sign_in_half_turn(Real64 a, Real64 biased) { return from_bits(a.bits() ^ ((biased.bits() & 2) << 62)); }
  /// a 2^k. Exact; a and the result must be normal.
  friend Real64 scale_by_power_of_two(Real64 a, Real64 biased) { return from_bits(a.bits() + (biased.bits() << 52)); }
  /// For a positive normal a: the whole number k with a 2^-k in [sqrt(1/2), sqrt(2)).
  friend Real64 binary_exponent(Real64 a) { return from_bits(((a.bits() + exponent_offset) >> 52) | two_to_52) - (0x1p52 + 1024); }

  /// For x > largest_small_angle, writes its reduction to turns and rest.
  friend void reduce_large_angles(Real64 x, Real64& turns, Real64& rest) { reduce_large_angles(&x.v, &turns.v, &rest.v, 1); }

  /// For binary_exponent: adding the offset to the bits of a double puts 1024 + k into their upper 12.
  static constexpr std::uint64_t exponent_offset = std::bit_cast<std::uint64_t>(2.0) - std::bit_cast<std::uint64_t>(0x1.6a09e667f3bcdp-1);
  static constexpr std::uint64_t two_to_52 = std::bit_cast<std::uint64_t>(0x1p52);
  static constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;

 private:
  std::uint64_t bits() const { return std::bit_cast<std::uint64_t>(v); }
  static Real64 from_bits(std::uint64_t bits) { return std::bit_cast<double>(bits); }
};

#pragma push_macro("RAINREF_FN")
#undef RAINREF_FN
#define RAINREF_FN inline
#include "math/transcendental-inl.h"
#pragma pop_macro("RAINREF_FN")

/// The only rounding to float, to nearest even. Saturates at the largest float; NaN is not allowed.
inline float round_to_float(Real64 x) { return static_cast<float>(saturate_to_float(x).v); }

/// The functions of transcendental-inl.h for one float; domain and accuracy are documented there.
inline float exp_float(float x) { return round_to_float(exp_real(Real64(x))); }
inline float exp2_float(float x) { return round_to_float(exp2_real(Real64(x))); }
inline float log_float(float x) { return round_to_float(log_real(Real64(x))); }
inline float pow_float(float x, float y) { return round_to_float(pow_real(Real64(x), Real64(y))); }
inline float sin_float(float x) { return round_to_float(sin_real(Real64(x))); }
inline float cos_float(float x) { return round_to_float(cos_real(Real64(x))); }
inline float atan2_float(float y, float x) { return round_to_float(atan2_real(Real64(y), Real64(x))); }

}  // namespace rainref
