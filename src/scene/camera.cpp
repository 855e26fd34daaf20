#include "scene/camera.h"

#include <cmath>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::scene {
namespace {

// For a smaller sine of the angle between `up` and the view, the basis would consist of rounding errors.
constexpr double smallest_sine = 1e-9;

// tan of an angle in [0, 45] degrees within 1e-15 relative: Taylor series of sine and cosine in double, whose first omitted terms are below
// 2e-18 at pi/4. Library functions differ between machines.
double tan_of_degrees_to_45(double degrees) {
  constexpr double radians_per_degree = 0.017453292519943295;
  const double x = degrees * radians_per_degree;
  const double y = x * x;
  // term n of each series is the one before it times y / (n (n - 1)); Horner from the smallest
  double sine = 1, cosine = 1;
  for (int n = 17; n >= 3; n -= 2) sine = 1 - y / (n * (n - 1)) * sine;
  for (int n = 18; n >= 2; n -= 2) cosine = 1 - y / (n * (n - 1)) * cosine;
  return x * sine / cosine;
}

bool is_finite(const Vector3& a) { return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]); }

}  // namespace

Vector3 normalized(const Vector3& a) { return a / std::sqrt(glm::dot(a, a)); }

Camera::Basis Camera::basis() const {
  // normalized() gives NaN for a zero vector, and if the vector or its square is not finite.
  const Vector3 forward = normalized(target - position);
  if (!is_finite(forward) || dot(forward, forward) < 0.5) {
    throw Error(ExitCode::usage, "camera: position and target coincide or are not finite, so there is no view");
  }
  const Vector3 side = cross(forward, normalized(up));
  if (!(dot(side, side) > smallest_sine * smallest_sine)) {
    throw Error(ExitCode::usage, "camera: up is zero or parallel to the view, so there is no right");
  }
  const Vector3 right = normalized(side);
  return {right, cross(right, forward), forward};
}

double Camera::half_height() const {
  if (!(vertical_fov_deg > 0 && vertical_fov_deg < 180)) {
    throw Error(ExitCode::usage,
                fmt::format("camera: expected a vertical field of view between 0 and 180 [deg], found {}", vertical_fov_deg));
  }
  const double half = vertical_fov_deg / 2;
  // 90 - half is exact for half in [45, 90], so nothing is lost near the pole.
  return half <= 45 ? tan_of_degrees_to_45(half) : 1 / tan_of_degrees_to_45(90 - half);
}

}  // namespace rainref::scene
