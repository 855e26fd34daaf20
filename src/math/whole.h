// Conversion of numbers to integers, defined for every number.
#pragma once

namespace rainref {

/// x cut toward zero and held to [low, high]; of a NaN low. low and high are exact as doubles; low <= high.
inline int whole_within(double x, int low, int high) {
  if (!(x > low)) return low;
  return x < high ? static_cast<int>(x) : high;
}

}  // namespace rainref
