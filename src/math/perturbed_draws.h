// Random draws of the variations, by the current behaviour.
#pragma once

#include <bit>
#include <cstdint>

#include "base/scramble.h"
#include "math/perturbed.h"

namespace rainref::perturbed {

/// splitmix64: draws of the variations only.
inline std::uint64_t draw() { return scramble(behaviour().random += scramble_step); }
inline bool coin() { return draw() & 1; }
/// In [-1, 1), often one of the ends.
inline double swing() {
  const std::uint64_t bits = draw();
  if (behaviour().lean != 0 && (bits & 14) != 0) return behaviour().lean;
  if (bits & 1) return bits & 2 ? 1 : -1;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

inline double magnitude(double x) { return x < 0 ? -x : x; }
inline double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52); }

}  // namespace rainref::perturbed
