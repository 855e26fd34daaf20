// Conversion of numbers to integers, defined for every value.
#pragma once

namespace rainref {

/// x truncated and clamped to [low, high]; low for NaN. low and high are exact as doubles; low <= high.
inline int whole_within(double x, int low, int high) {
  if (!(x > low)) return low;
  return x < high ? static_cast<int>(x) : high;
}

}  // namespace rainref
