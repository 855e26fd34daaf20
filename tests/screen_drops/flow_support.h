// Panes and drops on them, for the tests of the flowing layer.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "drops/physics.h"
#include "image/images.h"
#include "screen_drops/flow.h"

namespace rainref::screen_drops::test {

using drops::Drop;

inline constexpr double pi = 3.14159265358979323846, degree = pi / 180, gravity = 9.80665;

/// A pane of 0.32 m x 0.24 m in a small texture; no rain, no evaporation, no trails.
inline FlowSettings dry_pane() {
  FlowSettings s;
  s.pane = {0.32, 0.24};
  s.wind = 0;
  s.drops.capacity = 4000;
  s.drops.lifetime = 4096;
  s.drops.humidity = 1;
  s.drops.trail_thickness = s.drops.film_drying = 0;
  s.splat.width = 89;
  s.splat.height = 67;
  return s;
}
/// Heavy rain in a strong wind, trails, dry air: water takes every way.
inline FlowSettings wet_pane() {
  FlowSettings s = dry_pane();
  s.wind = 12;
  s.drops.seed = 3;
  s.drops.rain_rate = 80;
  s.drops.humidity = 0.4;
  s.drops.trail_thickness = 5e-6;
  s.drops.film_drying = 2e-6;
  return s;
}

inline double volume_of(double mass) { return mass * drops::mass_unit / drops::water_density; }
/// Of a drop that had this diameter [m] in the air, in mass units.
inline float mass_of(double diameter) {
  return static_cast<float>(std::round(drops::water_density * pi / 6 * diameter * diameter * diameter / drops::mass_unit));
}
inline Drop drop_at(float u, float v, float mass, std::uint32_t id = 0) { return {{u, v}, {0, 0}, mass, 4096, id, 0}; }

/// A lone drop in the middle of a pane, after some frames.
inline Drop after(const FlowSettings& settings, float mass, int frames, const parallel::Executor& executor) {
  Flow flow(settings, executor);
  const std::vector<Drop> one{drop_at(0.5f, 0.75f, mass)};
  flow.set_drops(one);
  for (int n = 0; n < frames; ++n) flow.simulate();
  return flow.drops().at(0);
}

template <class T>
std::string bytes_of(const std::vector<T>& all) {
  return {reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T)};
}

}  // namespace rainref::screen_drops::test
