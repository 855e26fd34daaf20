// The ground floor: glazed shops, cafes, shutters and entrances.
#include "night_street/city.h"
#include "night_street/facade.h"
#include "night_street/tubes.h"

namespace rainref::night_street {

namespace {

constexpr double glass_foot = 0.62, glass_head = 3.15, fascia_foot = 3.30, fascia_head = 4.02;

/// Goods on a shelf or people at a table: a colour for each cell, the same from every direction.
Vec goods_colour(const City& city, const Lot& lot, std::int64_t i, std::int64_t j) {
  const std::uint64_t key = scramble(lot.id ^ pair_key(i, j));
  const double hue = city.random(key, Purpose::goods), tone = 0.25 + 0.75 * city.random(key, Purpose::goods_tone);
  const Vec warm{0.9, 0.45, 0.25}, green{0.35, 0.65, 0.40}, blue{0.30, 0.42, 0.85}, pale{0.85, 0.82, 0.75};
  return tone * (hue < 0.3 ? warm : hue < 0.45 ? green : hue < 0.65 ? blue : pale);
}

Vec interior(const City& city, const Lot& lot, const FacadePoint& at, double width) {
  const double depth = 5, height = 3.4;
  const RoomPoint seen = look_into_room(at.u, at.y, at.into, width, height, depth);
  const double fall = 1 / (1 + 0.05 * square(seen.p.z));
  switch (seen.surface) {
    case RoomPoint::ceiling: {
      const bool is_strip = fraction(seen.p.z / 1.6) < 0.14 && fraction(seen.p.x / 1.9) < 0.75;
      return (is_strip ? 2.6 : 0.55 * fall) * lot.shop_light;
    }
    case RoomPoint::floor:
      return (0.22 * fall) * lot.shop_light;
    case RoomPoint::back_wall:
    case RoomPoint::side_wall:
      break;
  }
  const double along = seen.surface == RoomPoint::back_wall ? seen.p.x : seen.p.z;
  const double shelf = lot.shop == Shop::cafe ? 0.9 : 0.46, pitch = lot.shop == Shop::cafe ? 0.7 : 0.27;
  const double rise = fraction(seen.p.y / shelf);
  const double shade = (0.45 + 0.2 * seen.p.y) * fall;
  if (seen.p.y > 2.5) return (0.6 * shade) * lot.shop_light;
  if (rise > 0.93) return (0.5 * shade) * lot.shop_light;  // the edge of a shelf
  const std::int64_t column = floor_int(along / pitch), row = floor_int(seen.p.y / shelf);
  const Vec goods = goods_colour(city, lot, column, row);
  const double tall = 0.35 + 0.5 * fraction(goods.x * 37 + goods.z * 11), x = fraction(along / pitch);
  const Vec shown = rise < tall && x > 0.08 && x < 0.92 ? goods : Vec{0.16, 0.14, 0.12};
  return shade * mix(shown, Vec{0.34, 0.30, 0.27}, 0.7 * at.soft) * lot.shop_light;
}

/// Objects in the window, dark against the light, which give the shop depth.
bool is_display(const City& city, const Lot& lot, double u, double y) {
  const std::int64_t i = floor_int(u / 0.42);
  const std::uint64_t key = scramble(lot.id * 131 + static_cast<std::uint64_t>(i + 64));
  const double tall = glass_foot + (lot.shop == Shop::cafe ? 0.75 : 0.5) * city.random(key, Purpose::display);
  const double x = fraction(u / 0.42) - 0.5;
  return y < tall && magnitude(x) < 0.2 + 0.2 * (tall - y);
}

Vec shutter(const Lot& lot, const FacadePoint& at) {
  const double rib = mix(0.6 + 0.6 * fraction(at.y * 9), 0.9, at.soft);
  return rib * mix(Vec{0.16, 0.16, 0.17}, lot.wall, 0.3) * at.light;
}

Vec entrance(const City& city, const Lot& lot, const FacadePoint& at, double width) {
  const Vec wall = 1.05 * lot.wall * at.light;
  const double from_middle = magnitude(at.u - 0.5 * width);
  if (from_middle < 0.62 && at.y < 2.4) {
    if (from_middle > 0.55) return 0.5 * wall;
    return at.y > 1.05 && from_middle < 0.4 ? Vec{0.30, 0.21, 0.12} : 0.35 * wall;
  }
  if (from_middle < 0.62 && at.y > 2.48 && at.y < 2.95) return 1.3 * Vec{1.0, 0.72, 0.40};  // transom light
  const double x = fraction(at.u / 2.4);
  if (from_middle > 1.2 && at.y > 1.1 && at.y < 2.9 && x > 0.25 && x < 0.75) {
    const std::uint64_t key = scramble(lot.id * 31 + static_cast<std::uint64_t>(floor_int(at.u / 2.4)));
    if (x < 0.27 || x > 0.73 || magnitude(x - 0.5) < 0.012 || at.y < 1.15 || at.y > 2.85 || magnitude(at.y - 2.35) < 0.03)
      return 0.5 * wall;
    if (city.random(key, Purpose::window_lit) > 0.3) return glass_reflection(at);
    const double fold = 0.8 + 0.3 * fraction(x * 22);  // a drawn curtain
    return (mix(fold, 0.95, at.soft) * (0.2 + 0.25 * at.y)) * Vec{1.0, 0.55, 0.22} + glass_reflection(at);
  }
  const double course = fraction(at.y / 0.48) < 0.06 ? 0.5 : 1;  // rusticated stone
  return (mix(course, 1, at.soft) * (0.8 + 0.4 * city.stain.value(at.u * 1.2, at.y * 0.7))) * wall;
}

}  // namespace

Vec shop_radiance(const City& city, const Lot& lot, const FacadePoint& at) {
  const double width = lot.z1 - lot.z0, edge = min_of(at.u, width - at.u);
  const Vec wall = 0.8 * lot.wall * at.light;
  if (lot.front > plan::facade + 2) return entrance(city, lot, at, width);
  if (edge < 0.35) return (at.y < 0.4 ? 0.6 : 1.0) * wall;  // pilaster
  if (at.y > fascia_foot && at.y < fascia_head && lot.fascia >= 0) {
    const Sign& sign = city.signs[static_cast<std::size_t>(lot.fascia)];
    const double sign_width = sign.board.high.z - sign.board.low.z, left = 0.5 * (width - sign_width);
    const Vec board = 0.3 * wall + 0.0035 * sign.colour;
    if (at.u < left || at.u > left + sign_width) return board;
    return board + tube_radiance(sign, sign_width, fascia_head - fascia_foot, at.u - left, at.y - fascia_foot, at.soft);
  }
  if (lot.shop == Shop::entrance) return entrance(city, lot, at, width);
  if (at.y > glass_head) return 0.7 * wall;
  if (lot.shop == Shop::shutter) return at.y < 0.15 ? 0.4 * wall : shutter(lot, at);

  const double door = 0.5 + (width - 2.2) * city.random(lot.id, Purpose::shop_door);
  const double in_door = at.u - door;
  const bool is_door = in_door > 0 && in_door < 1.15;
  if (!is_door && at.y < glass_foot) return (at.y < 0.2 ? 0.4 : 0.9) * wall;
  const double pitch = (width - 0.7) / static_cast<double>(floor_int((width - 0.7) / 1.7) + 1);
  const double pane = fraction((at.u - 0.35) / pitch), bar = min_of(pane, 1 - pane) * pitch;
  const bool is_frame = is_door ? min_of(in_door, 1.15 - in_door) < 0.08 || at.y < 0.35 || magnitude(at.y - 2.3) < 0.05
                                : bar < 0.035 || at.y < glass_foot + 0.06 || at.y > glass_head - 0.07;
  if (is_frame) return 0.25 * wall + 0.01 * lot.shop_light;
  const Vec lit = interior(city, lot, at, width);
  const double shade = !is_door && is_display(city, lot, at.u, at.y) ? 0.22 : 1;
  return shade * lit + glass_reflection(at);
}

}  // namespace rainref::night_street
