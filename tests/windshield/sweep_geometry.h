// What the tests of wipe_drops share: one blade on the default glass, a step of the pass, and the geometry of a sweep.
#pragma once

#include <algorithm>

#include "windshield/motion/kernels.h"
#include "windshield/scalar.h"
#include "windshield/support.h"

namespace rainref::windshield {

constexpr bool corrected = true;

// One blade whose widened sweep lies on the default glass as a whole.
inline WiperSettings inner_blade(double cycles_per_minute = 60, double half_width = 0.008) {
  WiperSettings s;
  s.blades = {{{0.7, 0.08}, 0.15, 0.6, 20 * degree, 140 * degree, 0}};
  s.cycles_per_minute = cycles_per_minute;
  s.half_width = half_width;
  return s;
}
inline WipeDropsUniforms uniforms_of(const std::vector<Wiper>& wipers, bool is_corrected, int columns = 0, int rows = 0,
                                     const Capture& capture = {}) {
  return wipe_drops_uniforms(default_glass(), is_corrected, static_cast<int>(wipers.size()), capture, radius_scale, columns, rows);
}
inline std::uint64_t wipe(DropArrays& drops, const std::vector<Wiper>& wipers, Image& film) {
  static const parallel::Executor executor(1);
  return wipe_drops(uniforms_of(wipers, corrected, film.width(), film.height()), corrected, wipers, drops.spans(), &film, executor);
}

// ---- geometry, written again in double with polar angles -----------------------------------------------------------
struct Point {
  double x, y;
};
inline Point in_plane(const DropArrays& d, std::size_t i) {
  const Real2 p = default_glass().plane().to_plane({d.u[i], d.v[i]});
  return {p[0], p[1]};
}
inline double blade_distance(const Wiper& w, double angle, Point p) {
  const double rx = p.x - w.pivot[0], ry = p.y - w.pivot[1];
  const double along = std::clamp(rx * std::cos(angle) + ry * std::sin(angle), double(w.inner_radius), double(w.outer_radius));
  return std::hypot(rx - along * std::cos(angle), ry - along * std::sin(angle));
}
// Distance of p from the blade, at its nearest in the sweep: 0 where the blade itself passes.
inline double sweep_distance(const Wiper& w, Point p) {
  const double a0 = std::atan2(w.previous_axis[1], w.previous_axis[0]);
  const double turn = std::remainder(std::atan2(w.axis[1], w.axis[0]) - a0, 2 * pi);
  const double to = std::remainder(std::atan2(p.y - w.pivot[1], p.x - w.pivot[0]) - a0, 2 * pi) / turn;
  const double radius = std::hypot(p.x - w.pivot[0], p.y - w.pivot[1]);
  double distance = std::min(blade_distance(w, a0, p), blade_distance(w, a0 + turn, p));
  if (0 <= to && to <= 1) distance = std::min(distance, std::max({0.0, w.inner_radius - radius, radius - w.outer_radius}));
  return distance;
}

}  // namespace rainref::windshield
