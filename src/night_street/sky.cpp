#include "night_street/sky.h"

#include "night_street/city.h"

namespace rainref::night_street {

namespace {

constexpr Vec zenith{0.0062, 0.0062, 0.0140};
constexpr double tower_width = 14;

}  // namespace

Vec sky_gradient(const Vec& d) {
  const double up = clamp01(d.y), low = 1 - up;
  return mix(zenith, haze_glow, low * low * low);
}

Vec sky(const City& city, const Vec& d) {
  const double up = clamp01(d.y);
  // Clouds are on a flat ceiling; the offset keeps them finite at the horizon.
  const double reach = 1.9 / (up + 0.14);
  const double large = city.clouds_large.value(0.35 * reach * d.x, 0.35 * reach * d.z);
  const double small = city.clouds.layered(reach * d.x + 1.6 * large, reach * d.z, 4);
  const double cover = smooth_step(0.32, 0.74, 0.6 * small + 0.4 * large);
  const double near_horizon = 1 - smooth_step(0.0, 0.12, up);  // the clouds fade into the haze
  const double light = mix(0.45 + 1.25 * cover, 1, near_horizon);
  const Vec warm{0.0070, 0.0034, 0.0030};  // street light on the underside of the clouds
  return light * sky_gradient(d) + (cover * (1 - near_horizon)) * warm;
}

double skyline_height(const City& city, double end, double x) {
  const std::int64_t tower = floor_int(x / tower_width);
  const double u = city.skyline.lattice(tower, end > 0 ? 1 : 0);
  return 22 + 46 * u * u;
}

Vec skyline_radiance(const City& city, double end, const Vec& point) {
  const std::int64_t column = floor_int(point.x / 2.2), floor = floor_int(point.y / 3.2);
  const double u = fraction(point.x / 2.2), v = fraction(point.y / 3.2);
  const double tone = city.skyline.lattice(column + 977, 31 * floor + (end > 0 ? 7 : 0));
  const bool is_window = u > 0.25 && u < 0.75 && v > 0.3 && v < 0.75;
  const Vec wall{0.012, 0.011, 0.015};
  if (!is_window || tone > 0.2) return wall;
  return mix(Vec{1.6, 1.0, 0.5}, Vec{0.9, 1.1, 1.4}, tone * 5);
}

}  // namespace rainref::night_street
