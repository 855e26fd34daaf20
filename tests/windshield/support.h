// What the windshield's tests share: the default glass and drops as arrays.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "rainref/error.h"
#include "windshield/motion/kernels.h"
#include "windshield/motion/parameters.h"

namespace rainref::windshield {

inline constexpr double pi = 3.14159265358979323846, degree = pi / 180;

/// The message of the Error(usage) that body throws; "" without one.
inline std::string usage_error(const std::function<void()>& body) {
  try {
    body();
  } catch (const Error& e) {
    return e.code() == ExitCode::usage ? e.what() : std::string("another code: ") + e.what();
  }
  return "";
}

/// 1.4 m x 0.8 m, `slope` from the horizontal; u to the right, v up.
inline std::array<Real3, 3> corners_at(double slope, double width = 1.4, double height = 0.8) {
  return {{{1.9, width / 2, 1.0}, {1.9, -width / 2, 1.0}, {1.9 - height * std::cos(slope), width / 2, 1.0 + height * std::sin(slope)}}};
}
/// As the declared parameters have them.
inline std::array<Real3, 3> default_corners() {
  std::array<Real3, 3> corners{};
  for (const scene::Parameter& p : motion_parameters()) {
    for (int k = 0; k < 3; ++k) {
      if (p.key == "windshield.corner_" + std::to_string(k)) corners[k] = std::get<Real3>(p.default_value);
    }
  }
  return corners;
}
inline const Glass& default_glass() {
  static const Glass glass = make_glass(default_corners());
  return glass;
}

inline WiperSettings default_wipers(const Glass& glass, const char* arrangement = "tandem") {
  WiperSettings s;
  s.blades = arranged_blades(arrangement, 2, glass);
  return s;
}

struct DropArrays {
  std::vector<float> u, v, velocity_u, velocity_v, mass, life;
  std::vector<std::uint32_t> id;
  explicit DropArrays(std::size_t n) : u(n), v(n), velocity_u(n), velocity_v(n), mass(n, 1.0f), life(n, 1.0f), id(n) {
    for (std::size_t i = 0; i < n; ++i) id[i] = static_cast<std::uint32_t>(i);
  }
  DropSpans spans() { return {u, v, velocity_u, velocity_v, mass, life, id}; }
  std::size_t size() const { return u.size(); }
  bool operator==(const DropArrays&) const = default;
};
/// Drops spread uniformly over the glass, of 1 to 200000 mass units.
inline DropArrays random_drops(std::size_t n, std::uint32_t seed) {
  DropArrays d(n);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  for (std::size_t i = 0; i < n; ++i) {
    d.u[i] = unit(random);
    d.v[i] = unit(random);
    d.velocity_u[i] = unit(random) - 0.5f;
    d.velocity_v[i] = unit(random) - 0.5f;
    d.mass[i] = std::floor(1 + 2e5f * unit(random));
    d.life[i] = unit(random) < 0.1f ? -unit(random) : unit(random);
  }
  return d;
}

/// Base radius [m] of a drop of one mass unit: 3.5e-5 m gives a drop of 4 mm^3, 2 mm across in the air, a radius of 2 mm.
inline constexpr double radius_scale = 3.5e-5;

}  // namespace rainref::windshield
