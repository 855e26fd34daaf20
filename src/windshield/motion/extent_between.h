// Extent of a polygon across some rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace rainref::windshield {

using Corner = std::array<double, 2>;  ///< along and across the rows

/// Range of the convex hull of the corners between two ordinates; if empty, the first value is above the second. The lines between all
/// pairs of corners span the hull, in any order of the corners.
inline std::array<double, 2> extent_between(const std::array<Corner, 4>& corners, double low, double high) {
  std::array<double, 2> found{1e30, -1e30};
  const auto take = [&](double x) { found = {std::min(found[0], x), std::max(found[1], x)}; };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& from = corners[i];
    if (from[1] >= low && from[1] <= high) take(from[0]);
    for (std::size_t j = 0; j < i; ++j) {
      const Corner& to = corners[j];
      for (const double y : {low, high})
        if ((from[1] < y) != (to[1] < y)) take(from[0] + (to[0] - from[0]) * (y - from[1]) / (to[1] - from[1]));
    }
  }
  return found;
}

}  // namespace rainref::windshield
