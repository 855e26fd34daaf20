#include "night_street/wet_ground.h"

#include "night_street/city.h"

namespace rainref::night_street {

namespace {

/// Share of paint in [0, 1] on the road at (x, z).
double road_paint(double x, double z) {
  double paint = 0;
  if (magnitude(x) < 0.06) paint = soft_band(0.1, 3.1, 0.04, 9 * fraction(z / 9));  // dashes of 3 m every 9 m
  const double across = magnitude(x);
  if (across > 2.62 && across < 2.72) paint = 0.8;  // the line of the parking lane
  for (const double crossing : plan::crossings) {
    const double along = magnitude(z - crossing);
    if (along < plan::crossing_half_length) {
      paint = across < 4.2 ? soft_band(0.0, 0.5, 0.03, fraction(x + 0.25)) : 0;
    } else if (along < plan::crossing_half_length + 1.6 && across > 0.1 && across < 2.6 && along > plan::crossing_half_length + 1.2) {
      paint = 1;  // stop line
    }
  }
  return paint;
}

/// Slope of the ring that a fresh drop makes on standing water; there is one ring in each cell of 0.3 m.
void add_ring(const City& city, const Vec& point, double strength, double& slope_x, double& slope_z) {
  constexpr double cell = 0.3;
  const std::int64_t i = floor_int(point.x / cell), j = floor_int(point.z / cell);
  const std::uint64_t bits = random_bits(city.seed, pair_key(i, j), Purpose::ring);
  const auto draw = [bits](int shift) { return static_cast<double>(bits >> shift & 0xffff) * (1.0 / 65536); };
  const double x = point.x - cell * (static_cast<double>(i) + 0.42 + 0.16 * draw(0));
  const double z = point.z - cell * (static_cast<double>(j) + 0.42 + 0.16 * draw(16));
  const double radius = 0.11 * draw(32), from_centre = std::sqrt(x * x + z * z) + 1e-9;
  const double across = (from_centre - radius) * (1 / 0.014);  // in widths of the ring
  if (magnitude(across) >= 1) return;
  const double fade = strength * (1 - radius * (1 / 0.12)) * (draw(48) < 0.6 ? 1 : 0);
  const double slope = fade * across * square(1 - across * across) / from_centre;
  slope_x += slope * x;
  slope_z += slope * z;
}

}  // namespace

WetGround wet_ground(const City& city, Hit::Kind kind, const Vec& point, double distance) {
  const bool is_road = kind == Hit::road;
  WetGround ground;
  // Water gathers in hollows, in ruts, and along the kerb.
  const double hollow = city.puddles.layered(point.x * 0.42, point.z * 0.19, 3);
  const double gutter = is_road ? smooth_step(3.5, 4.45, magnitude(point.x)) : -0.6;
  ground.water = smooth_step(0.50, 0.60, hollow + 0.16 * gutter);

  const double paint = is_road ? road_paint(point.x, point.z) : 0;
  const double near = 1 / (1 + square(distance * (1.0 / 6)));
  const double grain = mix(1, 0.4 + 1.2 * city.asphalt.value(point.x * 90, point.z * 90), near);
  const double patch = 0.75 + 0.5 * city.stain.value(point.x * 0.7, point.z * 0.3);
  Vec base = is_road ? Vec{0.038, 0.037, 0.038} : Vec{0.088, 0.084, 0.080};
  if (!is_road) {  // slabs
    const double u = fraction(point.x / 0.6), v = fraction(point.z / 0.9);
    const double tone = city.asphalt.lattice(floor_int(point.x / 0.6), floor_int(point.z / 0.9));
    base = (min_of(min_of(u, 1 - u) * 0.6, min_of(v, 1 - v) * 0.9) < 0.008 ? 0.4 : 0.8 + 0.35 * tone) * base;
  }
  const double worn = 0.45 + 0.4 * city.stain.value(point.x * 3.1, point.z * 3.1);
  ground.albedo = mix((grain * patch) * base, Vec{0.36, 0.36, 0.34}, paint * worn);
  ground.albedo = (1 - 0.55 * ground.water) * ground.albedo;

  // Standing water is a mirror, roughened by rain; the film keeps the texture of the stones.
  ground.roughness = mix(is_road ? 0.17 : 0.27, 0.035, ground.water) * (1 - 0.25 * paint);
  const double swell = mix(0.030, 0.010, ground.water) / (1 + square(distance * (1.0 / 70)));
  double slope_x = swell * (city.ripple.value(point.x * 1.3, point.z * 1.3) - 0.5);
  double slope_z = 2.2 * swell * (city.ripple.value(point.x * 1.3 + 71.2, point.z * 1.3 - 33.9) - 0.5);
  // Beyond some metres slopes of centimetres are finer than a texel, and would show as streaks across the view.
  const double fine = mix(0.10, 0.012, ground.water) / (1 + square(distance * (1.0 / 6)));
  slope_x += fine * (city.asphalt.value(point.x * 14, point.z * 14) - 0.5);
  slope_z += fine * (city.asphalt.value(point.x * 14 + 53.7, point.z * 14 + 11.4) - 0.5);
  if (ground.water > 0.2 && distance < 40) {
    add_ring(city, point, 0.42 * ground.water / (1 + square(distance * (1.0 / 12))), slope_x, slope_z);
  }
  ground.normal = unit({-slope_x, 1, -slope_z});
  return ground;
}

}  // namespace rainref::night_street
