// The plane of a pane: three corners in the axes of the car, and the derived values for its passes.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "scene/parameter.h"

namespace rainref::windshield {

/// Diameter of the pupil of an eye that looks at the street; the edges of near objects are this wide [m].
inline constexpr double pupil = 0.005;

using scene::Real2;
using scene::Real3;

double dot(const Real3& a, const Real3& b);
Real3 cross(const Real3& a, const Real3& b);

/// Plane coordinates [m] from glass coordinates, and back:
///   x = f0 u + f1 v,  y = f2 v;   u = i0 x + i1 y,  v = i2 y.
struct PlaneFrame {
  Real3 frame, inverse;
  Real2 to_plane(const Real2& uv) const { return {frame[0] * uv[0] + frame[1] * uv[1], frame[2] * uv[1]}; }
  Real2 to_glass(const Real2& xy) const { return {inverse[0] * xy[0] + inverse[1] * xy[1], inverse[2] * xy[1]}; }
};

/// Corners of the glass at (u, v) = (0, 0), (1, 0) and (0, 1), car axes [m].
using Corners = std::array<std::array<double, 3>, 3>;

/// The point at (u, v) is origin + u e_u + v e_v. Car axes: x forward, y left, z up [m].
struct Glass {
  Real3 origin, e_u, e_v;
  Real3 normal;                          ///< unit, out of the car: e_v x e_u divided by its length
  std::array<double, 3> metric;          ///< e_u.e_u, e_u.e_v, e_v.e_v [m^2]
  std::array<double, 3> inverse_metric;  ///< of the symmetric matrix, in the same order [1/m^2]
  double area;                           ///< [m^2]

  /// An orthonormal frame whose x runs along e_u; exact on a sheared glass.
  PlaneFrame plane() const;
  /// As published: each axis divided by its own length, as if they were perpendicular.
  PlaneFrame axes() const;
};

/// The glass with corners at (0, 0), (1, 0) and (0, 1). Seen from inside the car these are the lower left, the lower right and the upper
/// left, possibly rotated. So their order determines the outside, also for a rear or side window. Throws Error(usage) with `keys` if they
/// span no plane: two coincide or all three lie on a line, to 1e-6 of their distances.
Glass make_glass(const Corners& corners, std::string_view keys = "windshield.corner_0, windshield.corner_1, windshield.corner_2");

/// "x y z, x y z, x y z; ...": the corners of each pane at (u, v) = (0, 0), (1, 0) and (0, 1) [m]. Throws Error(usage) with
/// windshield.panes and the pane.
std::vector<Corners> parse_panes(std::string_view text);

/// "windshield.panes, pane 2" for pane number k from 1 on; "the glass" for the windshield, number 0.
std::string pane_name(int number);

}  // namespace rainref::windshield
