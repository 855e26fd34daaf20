// The part of the glass that a blade may cover in a step. Outside it the passes skip its record, which changes no bit.
#pragma once

#include <algorithm>

#include "windshield/uniforms.h"

namespace rainref::windshield {

/// A rectangle of the plane [m].
struct Reach {
  float x0 = 1e30f, y0 = 1e30f, x1 = -1e30f, y1 = -1e30f;
  void hold(float x, float y) { *this = {std::min(x0, x), std::min(y0, y), std::max(x1, x), std::max(y1, y)}; }
  Reach wider(float by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
};

/// For the annular sector between a blade's two positions: beyond it the coverage is exactly 0.
inline Reach sector_reach(const Wiper& w, float edge_width) {
  Reach r;
  for (const float* axis : {w.previous_axis, w.axis})
    for (const float radius : {w.inner_radius, w.outer_radius}) r.hold(w.pivot[0] + radius * axis[0], w.pivot[1] + radius * axis[1]);
  // The arc's sagitta, the radius times 1 - cos(turn / 2), is at most the radius times (1 - cos(turn)) / 2.
  const float sagitta = w.outer_radius * 0.5f * (1.001f - (w.previous_axis[0] * w.axis[0] + w.previous_axis[1] * w.axis[1]));
  return r.wider(w.half_width + edge_width + 1e-3f + sagitta);
}

}  // namespace rainref::windshield
