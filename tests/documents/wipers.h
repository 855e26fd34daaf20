// What the windshield's blades do to drops and film, from docs/effects/windshield.md.
#pragma once

#include <optional>

#include "documents/drops_on_glass.h"

namespace rainref::documents {

struct Wiper {
  Float2 previous_inner, previous_outer, inner, outer, pivot;
  float inner_radius, outer_radius;
  Float2 previous_axis, axis;
  float half_width, rate, direction;
};
inline std::vector<Wiper> wipers_of(const Run& r) {
  std::vector<Wiper> wipers;
  for (int i = 0; i < r.whole("wiper_count"); ++i) {
    const auto two = [&](const char* member) { return Float2{r.of("wipers", i, member, 0), r.of("wipers", i, member, 1)}; };
    const auto one = [&](const char* member) { return r.of("wipers", i, member); };
    wipers.push_back({two("previous_inner"), two("previous_outer"), two("inner"), two("outer"), two("pivot"), one("inner_radius"),
                      one("outer_radius"), two("previous_axis"), two("axis"), one("half_width"), one("rate"), one("direction")});
  }
  return wipers;
}
/// glass(x, y).
inline Float2 glass(const Run& r, Float2 p) {
  return {r.u("inverse_frame", 0) * p.x + r.u("inverse_frame", 1) * p.y, r.u("inverse_frame", 2) * p.y};
}
inline float along_blade(const Wiper& w, Float2 r, Float2 axis) { return std::min(std::max(dot(r, axis), w.inner_radius), w.outer_radius); }
inline bool is_under(const Wiper& w, Float2 r, Float2 axis) {
  const Float2 away = r - along_blade(w, r, axis) * axis;
  return dot(away, away) <= w.half_width * w.half_width;
}

inline void wipe_drops_published(const Run& r, Given& out) {
  std::vector<Drop> drops = drops_of(r);
  const float follow = constant(r, 1, 0.9f) * r.u(r.unless("inherit for follow", "follow", "inherit"));
  for (Drop& d : drops)
    for (const Wiper& w : wipers_of(r)) {
      if (w.direction == 0) continue;
      const Float2 at = plane(r, d.position), from_pivot = at - w.pivot;
      const std::array corners{plane(r, w.previous_inner), plane(r, w.previous_outer), plane(r, w.outer), plane(r, w.inner)};
      bool in_quad = true;
      for (std::size_t k = 0; k < 4; ++k) in_quad = in_quad && w.direction * cross(corners[(k + 1) % 4] - corners[k], at - corners[k]) >= 0;
      if (!(d.life > 0) || !(in_quad || is_under(w, from_pivot, w.axis))) continue;
      const Float2 t = along_blade(w, from_pivot, w.axis) * w.axis +
                       (r.unless("behind the blade", 1.0f, -1.0f) * w.half_width * w.direction) * Float2{-w.axis.y, w.axis.x};
      d.position = mix(d.position, glass(r, w.pivot + t), follow);
      d.velocity = mix(d.velocity, glass(r, w.rate * Float2{-t.y, t.x}), r.u("inherit"));
      d.mass += r.unless("no gain", r.u("gain"), 0.0f);
    }
  give_live(drops, out);
}

inline bool is_in_sweep(const Wiper& w, Float2 at) {
  const Float2 r = at - w.pivot;
  if (is_under(w, r, w.previous_axis) || is_under(w, r, w.axis)) return true;
  const float least = w.inner_radius - w.half_width, most = w.outer_radius + w.half_width, squared = dot(r, r);
  return w.direction * cross(w.previous_axis, r) >= 0 && w.direction * cross(w.axis, r) <= 0 && dot(w.previous_axis + w.axis, r) > 0 &&
         squared >= least * least && squared <= most * most;
}

inline void wipe_drops_corrected(const Run& r, Given& out) {
  std::vector<Drop> drops = drops_of(r);
  const std::vector<Wiper> wipers = wipers_of(r);
  const int bin_count = r.whole("bin_count");
  const auto bin_of = [&](std::size_t k, Float2 at) {
    const Wiper& w = wipers[k];
    const float bins = static_cast<float>(bin_count), share = bins / (w.outer_radius - w.inner_radius + 2 * w.half_width);
    const float bin = std::floor((length(at - w.pivot) - (w.inner_radius - w.half_width)) * share);
    return static_cast<int>(k) * bin_count + static_cast<int>(std::min(std::max(bin, 0.0f), bins - 1));
  };
  std::vector<std::optional<int>> captured(drops.size());
  for (int round = 0; round < 2; ++round)
    for (std::size_t k = 0; k < wipers.size(); ++k) {
      const Wiper& w = wipers[k];
      if (w.direction == 0) continue;
      for (std::size_t i = 0; i < drops.size(); ++i) {
        Drop& d = drops[i];
        const Float2 at = plane(r, d.position), from_pivot = at - w.pivot;
        if (!is_in_sweep(w, at)) continue;
        const float distance = length(from_pivot);
        const float s = std::min((w.half_width + r.u("radius_scale") * cube_root(d.mass)) / std::max(distance, w.half_width), 1.0f);
        const float c = std::sqrt(std::max(1 - s * s, 0.0f)), z = constant(r, 1, 1.5f) * (w.direction * s);
        const Float2 moved = distance * Float2{c * w.axis.x - z * w.axis.y, c * w.axis.y + z * w.axis.x};
        d.position = glass(r, w.pivot + moved);
        d.velocity = glass(r, r.unless("thrown back", 1.0f, -1.0f) * w.rate * Float2{-moved.y, moved.x});
        captured[i] = bin_of(k, at);
      }
    }
  for (Drop& d : drops)
    for (const Wiper& w : wipers)
      if (w.direction != 0 && is_in_sweep(w, plane(r, d.position))) d.life = 0;

  std::vector<float> bins(wipers.size() * static_cast<std::size_t>(bin_count));
  for (int y = 0; y < r.whole("rows"); ++y)
    for (int x = 0; x < r.whole("columns"); ++x) {
      float water = r.at("film", x, y);
      const Float2 at = plane(r, {(static_cast<float>(x) + 0.5f) * r.u("texel", 0), (static_cast<float>(y) + 0.5f) * r.u("texel", 1)});
      for (std::size_t k = 0; k < wipers.size(); ++k) {
        if (wipers[k].direction == 0 || !is_in_sweep(wipers[k], at)) continue;
        bins[static_cast<std::size_t>(bin_of(k, at))] += water;
        water = 0;
        break;
      }
      out.store(out.index("film"), x, y, 0, water);
    }
  for (int bin = 0; bin < static_cast<int>(bins.size()); ++bin) {
    Drop* lowest = nullptr;
    for (std::size_t i = 0; i < drops.size(); ++i)
      if (captured[i] == bin && drops[i].life > 0 && (!lowest || drops[i].id < lowest->id)) lowest = &drops[i];
    if (lowest) lowest->mass = std::min(lowest->mass + bins[static_cast<std::size_t>(bin)], most_quanta);
  }
  give_live(drops, out);
}

inline float segment(Float2 p, Float2 a, Float2 b) {
  const float t = saturate(dot(p - a, b - a) / std::max(dot(b - a, b - a), 1e-12f));
  return length(p - a - t * (b - a));
}
/// Of one blade at a place of the plane.
inline float coverage_of(const Run& r, const Wiper& w, Float2 p) {
  float distance;
  if (!r.taken().corrected()) {
    const auto in_plane = [&](Float2 uv) { return Float2{uv.x * r.u("axis_length", 0), uv.y * r.u("axis_length", 1)}; };
    distance = segment(p, in_plane(w.inner), in_plane(w.outer));
  } else {
    const Float2 away = p - w.pivot;
    const float size = length(away), sigma = w.direction < 0 ? -1.0f : 1.0f;
    const float beside = std::max({sigma * cross(away, w.previous_axis), sigma * cross(w.axis, away), 0.0f});
    const float behind = std::max(-dot(away, w.previous_axis + w.axis), 0.0f);
    const auto blade = [&](Float2 axis) { return segment(away, w.inner_radius * axis, w.outer_radius * axis); };
    const float sector = std::max({w.inner_radius - size, size - w.outer_radius, 0.0f}) + 2 * (beside + behind);
    distance = std::min({blade(w.previous_axis), blade(w.axis), sector});
    if (r.is("the blade before forgotten")) distance = std::min(blade(w.axis), sector);
  }
  const float edge = r.unless("edge's width multiplies", r.u("edge_width"), 1 / r.u("edge_width"));
  return saturate(constant(r, 0.5f, 0.7f) + (w.half_width - distance) / edge);
}
inline float coverage(const Run& r, int x, int y) {
  const Float2 p = plane(r, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  float most = 0;
  for (const Wiper& w : wipers_of(r)) most = std::max(most, coverage_of(r, w, p));
  return most;
}
inline bool wipe_texture_published(const Run& r, int x, int y, float* out) {
  const float covered = coverage(r, x, y);
  out[0] = std::max(r.at("height", x, y) - r.u("strength") * r.unless("wipes everywhere", covered, 1.0f), 0.0f);
  out[1] = std::max(r.at("mask", x, y) * r.unless("mask does not fade", r.u("keep"), 1.0f), covered);
  return true;
}
inline bool wipe_texture_corrected(const Run& r, int x, int y, float* out) {
  const float covered = coverage(r, x, y), dt = r.unless("time counted twice", 1.0f, 2.0f) * r.u("dt");
  const float wiped = std::min(r.at("wiped", x, y) + dt, r.u("wiped_limit")) * (1 - r.unless("wiped not set back", covered, 0.0f));
  out[0] = r.at("height", x, y) * (1 - covered);
  out[1] = exponential(-r.unless("inverse of the time divides", wiped * r.u("inverse_tau"), wiped / r.u("inverse_tau")));
  out[2] = wiped;
  return true;
}

inline std::vector<Written> wipers_passes() {
  return {
      {{"windshield-as-published"}, "wipe_drops", "wrong constant", nullptr, wipe_drops_published},
      {{"windshield-corrected"}, "wipe_drops", "wrong constant", nullptr, wipe_drops_corrected},
      {{"windshield-as-published"}, "wipe_texture", "wrong constant", wipe_texture_published},
      {{"windshield-corrected"}, "wipe_texture", "wrong constant", wipe_texture_corrected},
  };
}

}  // namespace rainref::documents
