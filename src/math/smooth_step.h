// A smooth step for host computations in double.
#pragma once

namespace rainref {

/// 0 below 0, 1 above 1, the cubic 3t^2 - 2t^3 between.
inline double smooth_step(double a) {
  const double t = a < 0 ? 0 : a > 1 ? 1 : a;
  return t * t * (3 - 2 * t);
}

}  // namespace rainref
