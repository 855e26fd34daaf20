// The sums over lights are compiled once for each SIMD target, as plain loops over eight lanes that the compiler vectorizes. No operation
// crosses lanes before the one fixed sum at the end, so the bits are the same for all targets.
#include "night_street/compact_lights.h"

#include <algorithm>
#include <span>

#include "night_street/city.h"

#define RAINREF_KERNELS "night_street/compact_lights.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(night_street)
namespace {

constexpr double halo_reach = 30;                         ///< metres from a source at which its halo has faded to nothing
constexpr float aureole = 0.0040f, aureole_core = 0.03f;  ///< the tight glow: weight, and squared metres of its core
constexpr float veil = 0.0070f, veil_core = 5.0f;         ///< the wide one
constexpr float faded = aureole / (900 + aureole_core) + veil / (900 + veil_core);  ///< both at halo_reach
constexpr double lobe_reach = 5.4;                                                  ///< slope at which the lobe ends, in units of roughness
constexpr float lobe_end = 1 / (1 + 5.4f * 5.4f);

struct Sum {
  float red[8] = {}, green[8] = {}, blue[8] = {};
  Vec total() const {
    const auto fold = [](const float* a) { return static_cast<double>(((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]))); };
    return {fold(red), fold(green), fold(blue)};
  }
};

/// max(a, 0), written so that compilers see no branch in the loops below. Exact: a + |a| is 2a or 0.
inline float positive(float a) { return 0.5f * (a + std::fabs(a)); }

}  // namespace

Vec Halo(const LightGroup* groups, std::size_t count, const Ray& ray, double farthest) {
  const auto ox = static_cast<float>(ray.origin.x), oy = static_cast<float>(ray.origin.y), oz = static_cast<float>(ray.origin.z);
  const auto dx = static_cast<float>(ray.direction.x), dy = static_cast<float>(ray.direction.y), dz = static_cast<float>(ray.direction.z);
  const auto end = static_cast<float>(farthest);
  const Vec last = ray.at(farthest);
  const double z0 = min_of(ray.origin.z, last.z) - halo_reach, z1 = max_of(ray.origin.z, last.z) + halo_reach;
  Sum sum;
  for (const LightGroup& g : std::span(groups, count)) {
    if (g.bounds.high.z < z0 || g.bounds.low.z > z1) continue;
    for (std::size_t i = 0; i < LightGroup::lanes; ++i) {
      const float lx = g.x[i] - ox, ly = g.y[i] - oy, lz = g.z[i] - oz;
      const float along = lx * dx + ly * dy + lz * dz;
      const float inside = end - positive(end - positive(along));
      const float hx = lx - inside * dx, hy = ly - inside * dy, hz = lz - inside * dz;
      const float gap = hx * hx + hy * hy + hz * hz;
      const float tight = gap + aureole_core, wide = gap + veil_core;
      const float glow = (aureole * wide + veil * tight) / (tight * wide);
      // The haze between the halo and the eye dims it.
      const float clear = 1 / (1 + inside * inside * (1.0f / 8100.0f));
      const float towards = positive(-g.facing[i] * dz);
      const float shown = g.aside[i] + (1 - g.aside[i]) * towards * towards;
      const float weight = shown * positive(glow - faded) * clear;
      sum.red[i] += weight * g.red[i];
      sum.green[i] += weight * g.green[i];
      sum.blue[i] += weight * g.blue[i];
    }
  }
  return sum.total();
}

Vec Highlight(const LightGroup* groups, std::size_t count, const Vec& point, const Vec& view, const Vec& normal, double roughness) {
  const auto px = static_cast<float>(point.x), py = static_cast<float>(point.y), pz = static_cast<float>(point.z);
  const auto vx = static_cast<float>(view.x), vy = static_cast<float>(view.y), vz = static_cast<float>(view.z);
  const auto nx = static_cast<float>(normal.x), ny = static_cast<float>(normal.y), nz = static_cast<float>(normal.z);
  const auto alpha = static_cast<float>(roughness);
  const float nv = positive(nx * vx + ny * vy + nz * vz) + 1e-3f, k = 0.5f * alpha;
  const float view_shadow = 4 * (nv * (1 - k) + k);
  // For skipping groups: the horizontal direction away from the viewer, and the tilt of the normal.
  const double level = std::sqrt(view.x * view.x + view.z * view.z) + 1e-9;
  const double ax = -view.x / level, az = -view.z / level;
  const double tilt = std::sqrt(normal.x * normal.x + normal.z * normal.z) / normal.y;
  Sum sum;
  for (const LightGroup& g : std::span(groups, count)) {
    // The half vector (l + v) of a source at horizontal offset r, height y, distance d leans across the view by |r x a| / (y + v.y d); a
    // lobe reaches at most `slope`.
    const double cx = 0.5 * (g.bounds.low.x + g.bounds.high.x) - point.x, ex = 0.5 * (g.bounds.high.x - g.bounds.low.x);
    const double cz = 0.5 * (g.bounds.low.z + g.bounds.high.z) - point.z, ez = 0.5 * (g.bounds.high.z - g.bounds.low.z);
    const double reach = std::sqrt(cx * cx + cz * cz), extent = ex + ez;
    const double nearest = max_of(reach - extent, 0.5), farthest = reach + extent + g.bounds.high.y;
    const double slope = lobe_reach * (roughness + 0.5 * g.largest_radius / nearest) + tilt;
    const double across = magnitude(cx * az - cz * ax) - ex * magnitude(az) - ez * magnitude(ax);
    if (across > slope * (g.bounds.high.y + view.y * farthest)) continue;
    for (std::size_t i = 0; i < LightGroup::lanes; ++i) {
      const float lx = g.x[i] - px, ly = g.y[i] - py, lz = g.z[i] - pz;
      const float squared = lx * lx + ly * ly + lz * lz + 0.01f, scale = 1 / std::sqrt(squared);
      const float ux = lx * scale, uy = ly * scale, uz = lz * scale;
      const float nl = positive(nx * ux + ny * uy + nz * uz);
      const float hx = ux + vx, hy = uy + vy, hz = uz + vz;
      const float half2 = hx * hx + hy * hy + hz * hz + 1e-6f;  // = 4 (l.h)^2
      const float hn = positive(nx * hx + ny * hy + nz * hz), hn2 = hn * hn;
      // A sphere widens the lobe by half its angular radius and keeps the lobe's energy.
      const float wide = alpha + 0.5f * g.radius[i] * scale, wide2 = wide * wide;
      const float lobe = positive(wide2 * hn2 / (wide2 * hn2 + (half2 - hn2) + 1e-9f) - lobe_end);
      const float graze = positive(1 - 0.5f * std::sqrt(half2)), graze2 = graze * graze;
      const float fresnel = 0.02f + 0.98f * graze2 * graze2 * graze;
      const float towards = positive(-g.facing[i] * uz);
      const float shown = g.aside[i] + (1 - g.aside[i]) * towards * towards;
      const float weight = shown * lobe * lobe * fresnel * nl * 0.31830989f / (wide2 * view_shadow * (nl * (1 - k) + k) * squared);
      sum.red[i] += weight * g.red[i];
      sum.green[i] += weight * g.green[i];
      sum.blue[i] += weight * g.blue[i];
    }
  }
  return sum.total();
}

RAINREF_TARGET_END(night_street)

#if RAINREF_ONCE
namespace rainref::night_street {

RAINREF_EXPORT(Halo);
RAINREF_EXPORT(Highlight);

CompactLights::CompactLights(const std::vector<Source>& sources) {
  std::vector<const Source*> ordered;
  for (const Source& source : sources) {
    if (source.compact) ordered.push_back(&source);
  }
  std::stable_sort(ordered.begin(), ordered.end(), [](const Source* a, const Source* b) { return a->position.z < b->position.z; });
  for (std::size_t first = 0; first < ordered.size(); first += LightGroup::lanes) {
    LightGroup group{};  // lanes without a source keep zero light
    const Vec place = ordered[first]->position;
    group.bounds = {place, place};
    for (std::size_t i = 0; i < LightGroup::lanes; ++i) {
      group.z[i] = static_cast<float>(place.z);
      group.radius[i] = group.aside[i] = 1;
      if (first + i >= ordered.size()) continue;
      const Source& source = *ordered[first + i];
      const Vec p = source.position;
      group.x[i] = static_cast<float>(p.x);
      group.y[i] = static_cast<float>(p.y);
      group.z[i] = static_cast<float>(p.z);
      group.red[i] = static_cast<float>(source.intensity.x);
      group.green[i] = static_cast<float>(source.intensity.y);
      group.blue[i] = static_cast<float>(source.intensity.z);
      group.radius[i] = static_cast<float>(source.radius);
      group.largest_radius = std::max(group.largest_radius, group.radius[i]);
      if (magnitude(source.axis.z) > 0.5) {
        group.facing[i] = source.axis.z > 0 ? 1.0f : -1.0f;
        group.aside[i] = 0.05f;
      }
      Box& box = group.bounds;
      box.low = {min_of(box.low.x, p.x), min_of(box.low.y, p.y), min_of(box.low.z, p.z)};
      box.high = {max_of(box.high.x, p.x), max_of(box.high.y, p.y), max_of(box.high.z, p.z)};
    }
    groups_.push_back(group);
  }
}

Vec CompactLights::halo(const Ray& ray, double farthest) const {
  return RAINREF_DISPATCH(Halo)(groups_.data(), groups_.size(), ray, farthest);
}
Vec CompactLights::highlight(const Vec& point, const Vec& view, const Vec& normal, double roughness) const {
  return RAINREF_DISPATCH(Highlight)(groups_.data(), groups_.size(), point, view, normal, roughness);
}

}  // namespace rainref::night_street
#endif
