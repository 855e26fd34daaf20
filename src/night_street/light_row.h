// A row of a grid on which the street's light is summed up, in the form of the kernels.
#pragma once

#include <cstddef>

namespace rainref::night_street {

/// Points on the level ground (y = 0), or on the building line at x, whose normal faces the centre of the street. All in metres.
struct LightRow {
  bool is_ground;
  double x = 0;                ///< for a building line
  double first = 0, step = 1;  ///< of x on the ground, of the height on a building line
  std::size_t count = 0;
  double z = 0;
};

}  // namespace rainref::night_street
