// Light from lamps, shops and signs on the street, computed once on grids and looked up in shading.
#pragma once

#include <array>
#include <vector>

#include "base/rows.h"
#include "night_street/vec.h"

namespace rainref::night_street {

struct Source;

/// Irradiance / pi on the ground and on the two building lines (radiance is albedo times it), without shadows.
class LightMap {
 public:
  LightMap() = default;
  /// `rows` runs the summation and does not affect the bits.
  explicit LightMap(const std::vector<Source>& sources, const Rows& rows = rows_here);

  /// On the horizontal ground at (x, z).
  Vec ground(double x, double z) const;
  /// On the building line of side 0 (x < 0) or 1 (x > 0) at height y.
  Vec facade(int side, double y, double z) const;

 private:
  struct Grid {
    double first_a = 0, step_a = 1, first_z = 0, step_z = 1;
    int count_a = 0, count_z = 0;
    std::vector<Vec> cells;
    Vec at(double a, double z) const;
  };
  Grid ground_;
  std::array<Grid, 2> facade_;
};

}  // namespace rainref::night_street
