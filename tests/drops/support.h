// A windshield of 1.4 m x 0.8 m, and drops on it.
#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include "drops/drops.h"
#include "drops/host.h"
#include "drops/motion/passes.h"
#include "drops/motion/scalar.h"
#include "random/counter.h"

namespace rainref::drops::test {

using D = scalar::Scalar<double>;
using F = scalar::Scalar<float>;

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;
constexpr double standard_gravity = 9.80665;
constexpr double glass_width = 1.4, glass_height = 0.8;
constexpr PlaneFrame frame{glass_width, 0, glass_height};

/// The frame of a specific force and a wind along the glass, in metres: x to the right, y up.
inline GlassFrame glass_of(double force_x, double force_y, double wind_x = 0, double wind_y = 0) {
  GlassFrame g{};
  g.gravity[0] = static_cast<float>(force_x / glass_width);
  g.gravity[1] = static_cast<float>(force_y / glass_height);
  g.wind[0] = static_cast<float>(wind_x / glass_width);
  g.wind[1] = static_cast<float>(wind_y / glass_height);
  return g;
}
/// A parked car: only gravity, on glass inclined by beta [rad] from the horizontal.
inline GlassFrame parked(double beta) { return glass_of(0, -standard_gravity * std::sin(beta)); }

inline double mass_units_of_diameter(double d) { return std::round(998.2 * pi / 6 * d * d * d / mass_unit); }

inline Drop drop(float u, float v, float mass, std::uint32_t id, float velocity_u = 0, float velocity_v = 0, float life = 100) {
  return {{u, v}, {velocity_u, velocity_v}, mass, life, id, 0};
}
inline DropArrays arrays_of(const std::vector<Drop>& drops, std::int64_t capacity = 0) {
  DropArrays a(std::max<std::int64_t>(capacity, static_cast<std::int64_t>(drops.size())));
  a.assign(drops);
  return a;
}

/// Drops all over the glass, some slots free: places, velocities and masses from integers.
inline std::vector<Drop> random_drops(int count, std::uint32_t seed, float most_mass, float speed = 0.2f) {
  std::vector<Drop> out;
  for (int i = 0; i < count; ++i) {
    const auto r = random::block(seed, random::Purpose::drop_arrival, 77, static_cast<std::uint32_t>(i)),
               s = random::block(seed, random::Purpose::drop_arrival, 78, static_cast<std::uint32_t>(i));
    const auto signed_uniform = [](std::uint32_t w) { return 2 * random::uniform(w) - 1; };
    const float mass = std::floor(1 + most_mass * random::uniform(r[2]) * random::uniform(r[3]) * random::uniform(s[3]));
    out.push_back(drop(random::uniform(r[0]), random::uniform(r[1]), mass, static_cast<std::uint32_t>(i), speed * signed_uniform(s[0]),
                       speed * signed_uniform(s[1]), s[2] % 8 == 0 ? 0.0f : 5 * random::uniform(s[2])));
  }
  return out;
}

using drops::state_of;

}  // namespace rainref::drops::test
