// 8-bit unsigned normalized values: code / 255.
#pragma once

#include "rainref/storage.h"

namespace rainref {

/// code / 255, correctly rounded.
inline float to_float(Unorm8 u) { return static_cast<float>(u.code) / 255.0f; }

/// The code of x clamped to [0, 1], 0 for NaN: 255 x rounded to nearest even, or truncated. The product is rounded to float first, as in
/// the SIMD evaluation.
inline Unorm8 to_unorm8(float x, Rounding rounding = Rounding::rne) {
  const float clamped = x > 0.0f ? (1.0f < x ? 1.0f : x) : 0.0f, scaled = clamped * 255.0f;
  // Adding and subtracting 2^23 rounds to the nearest integer, ties to even.
  const float value = rounding == Rounding::rne ? (scaled + 0x1p23f) - 0x1p23f : scaled;
  return {static_cast<std::uint8_t>(value)};
}

}  // namespace rainref
