#include "night_street/facade.h"

#include "night_street/city.h"
#include "night_street/sky.h"

namespace rainref::night_street {

RoomPoint look_into_room(double u, double y, const Vec& into, double width, double height, double depth) {
  const auto until = [](double position, double velocity, double low, double high) {
    if (magnitude(velocity) < 1e-9) return 1e9;
    return ((velocity > 0 ? high : low) - position) / velocity;
  };
  const double to_side = until(u, into.x, 0, width), to_level = until(y, into.y, 0, height);
  const double to_back = until(0, max_of(into.z, 1e-6), 0, depth);
  const double t = max_of(0, min_of(to_back, min_of(to_side, to_level)));
  const Vec p{u + t * into.x, y + t * into.y, t * into.z};
  if (t >= to_back) return {RoomPoint::back_wall, p};
  if (to_side < to_level) return {RoomPoint::side_wall, p};
  return {into.y > 0 ? RoomPoint::ceiling : RoomPoint::floor, p};
}

Vec glass_reflection(const FacadePoint& at) {
  const double away = 1 - clamp01(at.into.z);  // 1 at grazing view
  const double fresnel = 0.05 + 0.75 * away * away * away * away * away;
  const Vec mirrored{at.into.x, at.into.y, -at.into.z};
  return fresnel * (1.4 * sky_gradient(mirrored) + 0.25 * at.light) + 0.004 * Vec{0.8, 0.9, 1.2};
}

namespace {

/// A side wall, a roof, or the end of an alley: plain wet masonry.
Vec blank_wall(const City& city, const Lot& lot, const Hit& hit, const Vec& point) {
  if (hit.normal.y > 0.5) return 0.02 * Vec{0.9, 0.9, 1.2};
  const double deep = magnitude(point.x) - plan::facade;
  const double stain = 0.6 + 0.8 * city.stain.value(point.x * 0.8, point.y * 0.5);
  const Vec light = (0.55 / (1 + 0.25 * max_of(deep, 0))) * city.light().facade(hit.side, point.y, point.z);
  return (0.7 * stain) * lot.wall * (light + Vec{0.006, 0.005, 0.008});
}

}  // namespace

Vec building_radiance(const City& city, const Hit& hit, const Vec& point, const Vec& d, double soft) {
  const Lot& lot = city.lots[static_cast<std::size_t>(hit.side)][static_cast<std::size_t>(hit.index)];
  if (magnitude(hit.normal.x) < 0.5) return blank_wall(city, lot, hit, point);
  FacadePoint at;
  const bool is_right = hit.side == 1;  // a viewer of the right row sees +z on the right
  at.u = is_right ? point.z - lot.z0 : lot.z1 - point.z;
  at.y = point.y;
  at.into = {is_right ? d.z : -d.z, d.y, magnitude(d.x)};
  const double setback = 1 / (1 + 0.3 * (lot.front - plan::facade));
  at.light = setback * city.light().facade(hit.side, point.y, point.z) + Vec{0.006, 0.0052, 0.0075};
  at.soft = soft;
  return point.y < plan::ground_floor ? shop_radiance(city, lot, at) : storey_radiance(city, lot, at);
}

}  // namespace rainref::night_street
