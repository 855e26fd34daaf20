// The storeys above the shops: walls, cornices, and windows, some of them lit.
#include "night_street/city.h"
#include "night_street/facade.h"

namespace rainref::night_street {

namespace {

constexpr std::array<Vec, 6> lights{Vec{1.0, 0.50, 0.16}, Vec{1.0, 0.60, 0.27}, Vec{1.0, 0.76, 0.48},
                                    Vec{1.0, 0.42, 0.12}, Vec{0.66, 0.90, 1.0}, Vec{0.22, 0.40, 1.0}};

struct Room {
  double level;  ///< radiance of a wall close to the lamp
  Vec light;     ///< its colour
  double cover;  ///< share of the window behind blind or curtain
  int dressing;  ///< 0 bare, 1 blind from above, 2 curtains at both sides, 3 drawn
};

Room draw_room(const City& city, std::uint64_t id) {
  const double u = city.random(id, Purpose::window_level), tone = city.random(id, Purpose::window_tone);
  const auto pick = tone < 0.93 ? static_cast<std::size_t>(tone / 0.93 * 5) : std::size_t{5};
  Room room;
  room.level = 0.35 + 2.2 * u * u * u;
  room.light = lights[pick];
  const double dressing = city.random(id, Purpose::window_blind);
  room.dressing = static_cast<int>(4 * dressing);
  room.cover = 4 * dressing - room.dressing;
  return room;
}

/// The lit room seen through the pane; x, y in [0, 1] on the pane, u and height in metres in the room.
Vec room_radiance(const Room& room, const FacadePoint& at, double x, double y, double u, double v, double width, double height) {
  const RoomPoint seen = look_into_room(u, v, at.into, width, height, 3.6);
  const Vec lamp{0.5 * width, height - 0.35, 1.7}, away = seen.p - lamp;
  const double distance = 1.0 / (0.35 + 0.22 * dot(away, away));
  constexpr std::array<double, 4> shade{0.85, 0.65, 1.15, 0.30};
  double inside = room.level * shade[seen.surface] * min_of(distance, 1.5);
  if (dot(away, away) < 0.05) inside = 3.5 * room.level;
  const double cloth = room.level * (0.50 + 0.22 * y) * mix(0.86 + 0.28 * fraction(x * 9), 1, at.soft);
  bool hidden = false;
  if (room.dressing == 1) hidden = y > 1 - 0.8 * room.cover;
  if (room.dressing == 2) hidden = magnitude(x - 0.5) > 0.5 - 0.28 * room.cover;
  if (room.dressing == 3) hidden = room.cover < 0.7 || magnitude(x - 0.5) > 0.08;
  return (hidden ? 0.62 * cloth : inside) * room.light;
}

}  // namespace

Vec storey_radiance(const City& city, const Lot& lot, const FacadePoint& at) {
  const double width = lot.z1 - lot.z0, above = at.y - plan::ground_floor;
  const double stain = 0.70 + 0.6 * city.stain.layered(at.u * 0.9 + static_cast<double>(lot.id % 997), at.y * 0.22, 2);
  Vec wall = stain * lot.wall * at.light;
  const std::int64_t storey = floor_int(above / lot.storey);
  const double v = above - static_cast<double>(storey) * lot.storey;
  const double top = lot.height - 0.9;
  if (at.y > top - 0.02) {  // cornice: a bright lip over a dark line
    const double lip = at.y - top;
    return (lip < 0.18 ? 0.25 : lip < 0.5 ? 1.25 : 0.8) * wall;
  }
  if (at.u < 0.12 || at.u > width - 0.12) return 0.35 * wall;  // the joint between two houses
  if (v < 0.10 && lot.style != 2) return 1.35 * wall;          // string course
  if (v < 0.16 && lot.style != 2) return 0.45 * wall;          // and its shadow
  const double margin = 0.5, bay = (width - 2 * margin) / lot.bays;
  const double across = (at.u - margin) / bay;
  const std::int64_t column = floor_int(across);
  if (column < 0 || column >= lot.bays) return wall;
  const double x = (fraction(across) - 0.5 * (1 - lot.window_width)) / lot.window_width;
  const double sill = 0.28 * lot.storey, pane_height = lot.window_height * lot.storey;
  const double y = (v - sill) / pane_height;
  const double pane_width = lot.window_width * bay;
  if (y < 0 && y > -0.11 / pane_height && x > -0.06 && x < 1.06) return 1.5 * wall;  // window sill
  if (x < 0 || x > 1 || y < 0 || y > 1) {
    const bool is_lintel = lot.style == 2 && y > 1 && y < 1.14 && x > -0.08 && x < 1.08;
    if (is_lintel) return 1.4 * wall;
    // Courses of brick or blocks, near the viewer only.
    const double course = fraction(at.y * 3.2) < 0.12 ? 0.8 : 1.0;
    const double block = 0.86 + 0.28 * city.stain.lattice(floor_int(at.u * 1.9 + 0.5 * static_cast<double>(floor_int(at.y * 3.2) & 1)),
                                                          floor_int(at.y * 3.2));
    return mix(course * block, 1, at.soft) * wall;
  }
  const double edge_x = min_of(x, 1 - x) * pane_width, edge_y = min_of(y, 1 - y) * pane_height;
  const int leaves = lot.style == 1 ? 3 : 2;
  const double leaf = fraction(x * leaves), bar = min_of(leaf, 1 - leaf) * pane_width / leaves;
  const bool is_transom = lot.style != 1 && magnitude(y - (lot.style == 2 ? 0.5 : 0.72)) * pane_height < 0.03;
  if (min_of(edge_x, edge_y) < 0.055 || bar < 0.026 || is_transom) return 0.55 * wall + 0.002 * Vec{1, 1, 1};

  const std::uint64_t id = scramble(lot.id * 4096 + static_cast<std::uint64_t>(storey) * 64 + static_cast<std::uint64_t>(column));
  const Vec reflection = glass_reflection(at);
  // Offices light whole floors, homes single rooms.
  const std::uint64_t floor_id = scramble(lot.id * 64 + static_cast<std::uint64_t>(storey) + 7);
  const bool whole_floor = lot.style == 1 && city.random(floor_id, Purpose::window_lit) < 0.3;
  const double chance = whole_floor ? 0.9 : lot.style == 1 ? 0.5 * lot.lit_share : lot.lit_share;
  if (city.random(id, Purpose::window_lit) >= chance) return reflection;
  Room room = draw_room(city, id);
  if (whole_floor) {
    room.light = lights[city.random(floor_id, Purpose::window_tone) < 0.5 ? 4 : 2];
    room.level = 0.7 + 0.8 * city.random(floor_id, Purpose::window_level);
    if (room.dressing >= 2) room.dressing = 0;
  }
  return room_radiance(room, at, x, y, fraction(across) * bay, v, bay, lot.storey) + reflection;
}

}  // namespace rainref::night_street
