// Shared parts of comparisons of pictures.
#pragma once

#include <cmath>

#include "compositor/surface.h"
#include "truth/difference.h"
#include "math/constants.h"
#include "math/half.h"
#include "math/real64.h"
#include "math/unorm.h"

#include <glm/geometric.hpp>
#include "truth/tracer_names.h"

namespace rainref::truth {

inline double degrees_between(const Vec& a, const Vec& b) {
  const Vec c = cross(a, b);
  return atan2_real(Real64(__builtin_sqrt(dot(c, c))), Real64(dot(a, b))).v * (180 / pi);
}

/// The signed difference in the channel that differs most.
inline double largest_difference(const double (&trick)[3], const double (&truth)[3]) {
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = trick[k] - truth[k];
    if (std::abs(d) > std::abs(worst)) worst = d;
  }
  return worst;
}

inline void read(const Half* texel, double (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = to_float(texel[k]);
}
inline void read(const Unorm8* texel, double (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = texel[k].code;
}
/// The same for pixel (x, y) of two images of one format, T.
template <class T>
double pixel_difference(const Image& trick, const Image& truth, int x, int y) {
  double a[3], b[3];
  read(trick.row<T>(y) + 4 * x, a);
  read(truth.row<T>(y) + 4 * x, b);
  return largest_difference(a, b);
}

}  // namespace rainref::truth
