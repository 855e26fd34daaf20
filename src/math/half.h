// IEEE 754 binary16 by integer operations. This conversion defines stored halves.
//
//   s eeeee mmmmmmmmmm      value = (-1)^s * 2^(e-15) * 1.m        e in [1, 30]
//                                   (-1)^s * 2^-14 * 0.m           e = 0, subnormals kept
//                                   infinity (m = 0) or NaN        e = 31
//
// To half: nearest even (overflow to infinity from 65520 up) or toward zero (finite values never overflow).
// NaN becomes 0x7e00 with its sign. To float: exact, NaN payload shifted up as F16C does.
// Tested over all 65 536 halves and all 2^32 floats against F16C (tests/math/half_test.cpp, half_full).
#pragma once

#include <bit>
#include <cstdint>

#include "rainref/storage.h"

namespace rainref {

/// The float of equal value. Exact; a signalling NaN becomes quiet.
inline float to_float(Half h) {
  const std::uint32_t sign = static_cast<std::uint32_t>(h.bits & 0x8000u) << 16, magnitude = h.bits & 0x7fffu;
  if (magnitude >= 0x7c00u) {
    const std::uint32_t quiet = magnitude > 0x7c00u ? 0x400000u : 0u;
    return std::bit_cast<float>(sign | 0x7f800000u | (magnitude & 0x3ffu) << 13 | quiet);
  }
  if (magnitude >= 0x0400u) return std::bit_cast<float>(sign | ((magnitude << 13) + (112u << 23)));  // 112 = 127 - 15
  // Subnormal: mantissa * 2^-24, exact in float.
  return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(static_cast<float>(magnitude) * 0x1p-24f));
}

/// The half nearest to x, or the next toward zero; rounding as described at the top of this file.
inline Half to_half(float x, Rounding rounding = Rounding::rne) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x), sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
  if (magnitude >= 0x7f800000u) {
    return {static_cast<std::uint16_t>(sign | (magnitude > 0x7f800000u ? 0x7e00u : 0x7c00u))};
  }
  const std::uint32_t exponent = magnitude >> 23;
  // The significand with its hidden bit, and the number of bits dropped: 13 for normal halves, more below 2^-14.
  const std::uint32_t significand = exponent == 0 ? 0 : (magnitude & 0x7fffffu) | 0x800000u;
  const std::uint32_t dropped = exponent >= 113 ? 13 : exponent < 101 ? 25 : 126 - exponent;
  std::uint32_t code = significand >> dropped;
  if (exponent >= 113) code += (exponent - 113) << 10;  // the hidden bit adds the missing 1 of the exponent
  if (rounding == Rounding::rne) {
    const std::uint32_t rest = significand & ((1u << dropped) - 1), tie = 1u << (dropped - 1);
    code += rest > tie || (rest == tie && (code & 1));
    if (code > 0x7c00u) code = 0x7c00u;
  } else if (code >= 0x7c00u) {
    code = 0x7bffu;
  }
  return {static_cast<std::uint16_t>(sign | code)};
}

}  // namespace rainref
