#include "night_street/trace.h"

#include <algorithm>

#include "night_street/city.h"
#include "night_street/sky.h"

namespace rainref::night_street {

namespace {

constexpr double nothing = 1e9;

/// t at which the ray crosses the plane where its coordinate is `level`, from o in direction d; t <= 0 if it does not.
double cross_at(double level, double o, double d, double reciprocal) { return magnitude(d) < 1e-12 ? -1 : (level - o) * reciprocal; }

void trace_ground(const Ray& ray, Hit& hit) {
  const Vec& o = ray.origin;
  const Vec& d = ray.direction;
  const auto offer = [&](double t, Hit::Kind kind, const Vec& normal) {
    if (t > 0 && t < hit.t) hit = {kind, t, normal, 0, 0};
  };
  if (d.y < 0) {
    const double to_pavement = cross_at(plan::kerb_height, o.y, d.y, ray.reciprocal.y);
    if (magnitude(o.x + to_pavement * d.x) > plan::road_half_width) offer(to_pavement, Hit::pavement, {0, 1, 0});
    const double to_road = cross_at(0, o.y, d.y, ray.reciprocal.y);
    if (magnitude(o.x + to_road * d.x) <= plan::road_half_width) offer(to_road, Hit::road, {0, 1, 0});
  }
  if (magnitude(o.x) < plan::road_half_width) {
    const double kerb = d.x < 0 ? -plan::road_half_width : plan::road_half_width;
    const double t = cross_at(kerb, o.x, d.x, ray.reciprocal.x), y = o.y + t * d.y;
    if (y >= 0 && y <= plan::kerb_height) offer(t, Hit::kerb, {d.x < 0 ? 1.0 : -1.0, 0, 0});
  }
}

/// The lot that contains z, clamped to the first and the last.
int lot_at(const std::vector<Lot>& lots, double z) {
  const auto after = std::upper_bound(lots.begin(), lots.end(), z, [](double a, const Lot& lot) { return a < lot.z0; });
  return std::max(0, static_cast<int>(after - lots.begin()) - 1);
}

void trace_buildings(const City& city, const Ray& ray, int side, Hit& hit) {
  const std::vector<Lot>& lots = city.lots[static_cast<std::size_t>(side)];
  const double sign = side == 0 ? -1 : 1;
  const Box row{{side == 0 ? -plan::back : plan::facade, 0, lots.front().z0},
                {side == 0 ? -plan::facade : plan::back, plan::tallest, lots.back().z1}};
  double entry = 0;
  if (!crosses(row, ray, hit.t, entry)) return;
  // Walk the lots in the order of the ray.
  const int step = ray.direction.z < 0 ? -1 : 1;
  for (int i = lot_at(lots, ray.origin.z + max_of(entry, 0) * ray.direction.z); i >= 0 && i < static_cast<int>(lots.size()); i += step) {
    const Lot& lot = lots[static_cast<std::size_t>(i)];
    const Box box{{side == 0 ? -plan::back : lot.front, 0, lot.z0}, {side == 0 ? -lot.front : plan::back, lot.height, lot.z1}};
    double t = 0;
    if (crosses(box, ray, hit.t, t) && t > 0) {
      hit = {Hit::building, t, entry_normal(box, ray), side, i};
      return;
    }
    const double leave = ((step > 0 ? lot.z1 : lot.z0) - ray.origin.z) * ray.reciprocal.z;
    if (leave > hit.t || sign * (ray.origin.x + leave * ray.direction.x) > plan::back) return;
    if (magnitude(ray.direction.z) < 1e-12 || ray.origin.y + leave * ray.direction.y > plan::tallest) return;
  }
}

void trace_skyline(const City& city, const Ray& ray, Hit& hit) {
  const double end = ray.direction.z < 0 ? -1 : 1;
  const double t = cross_at(end * plan::skyline, ray.origin.z, ray.direction.z, ray.reciprocal.z);
  if (t <= 0 || t >= hit.t) return;
  const Vec p = ray.at(t);
  if (p.y >= 0 && p.y < skyline_height(city, end, p.x)) hit = {Hit::skyline, t, {0, 0, -end}, 0, 0};
}

}  // namespace

Hit trace(const City& city, const Ray& ray, bool with_lamps) {
  Hit hit;
  hit.t = nothing;
  trace_ground(ray, hit);
  // Large objects first, because they shorten the search among the small ones.
  for (const int side : {0, 1}) trace_buildings(city, ray, side, hit);
  trace_skyline(city, ray, hit);
  double farthest = hit.t;
  int first = 0;  // of solids at the same distance the one with the lowest index, whatever the order of the search
  city.hierarchy.walk(ray, farthest, [&](int index, double& limit) {
    const Solid& solid = city.solids[static_cast<std::size_t>(index)];
    if (!with_lamps && solid.shape == Solid::sphere && city.materials[static_cast<std::size_t>(solid.material)].emission.x > 0) return;
    SolidHit met;
    if (!intersect(solid, city.planes, ray, 1e-9, nothing, met) || met.t > limit) return;
    if (met.t == limit && index >= first) return;
    limit = met.t;
    first = index;
    hit = {Hit::solid, met.t, met.normal, 0, index};
  });
  if (hit.kind == Hit::sky) hit.t = 0;
  return hit;
}

}  // namespace rainref::night_street
