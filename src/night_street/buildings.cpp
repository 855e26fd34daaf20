// The two rows of buildings, their shops and their signs.
#include "night_street/city.h"

namespace rainref::night_street {

namespace {

constexpr std::array<Vec, 7> neon{Vec{9, 0.35, 5.2},  Vec{0.4, 6.5, 8.2}, Vec{10, 0.5, 0.35}, Vec{0.5, 8, 1.6},
                                  Vec{9.5, 4.2, 0.4}, Vec{2.0, 1.4, 10},  Vec{9, 0.9, 2.2}};
constexpr std::array<std::string_view, 9> upright_words{"HOTEL", "BAR", "CAFE", "KINO", "RAMEN", "CLUB", "PIZZA", "DELI", "TAXI"};
constexpr std::array<std::string_view, 10> level_words{"NOODLES", "BOOKS",  "COFFEE", "FLOWERS",  "PHARMACY",
                                                       "TAILOR",  "MARKET", "CINEMA", "LATE BAR", "RECORDS"};

template <class List>
auto pick(const List& list, double u) {
  return list[static_cast<std::size_t>(u * static_cast<double>(list.size()))];
}

Lot draw_lot(const City& city, std::uint64_t id, double z) {
  const auto r = [&](Purpose purpose) { return city.random(id, purpose); };
  constexpr std::array<Vec, 6> walls{Vec{0.20, 0.13, 0.10}, Vec{0.26, 0.24, 0.21}, Vec{0.15, 0.15, 0.16},
                                     Vec{0.30, 0.25, 0.17}, Vec{0.12, 0.09, 0.08}, Vec{0.22, 0.20, 0.22}};
  Lot lot{};
  lot.id = id;
  lot.z0 = z;
  lot.z1 = z + 7.5 + 8.5 * r(Purpose::lot_width);
  lot.front = plan::facade + (r(Purpose::lot_setback) < 0.2 ? 0.9 : 0.0);
  lot.storey = 3.0 + 0.7 * r(Purpose::lot_storey);
  const double u = r(Purpose::lot_height);
  const int storeys = 2 + static_cast<int>(5 * u) + (u > 0.88 ? 2 : 0);
  lot.height = plan::ground_floor + storeys * lot.storey + 0.9;
  lot.style = static_cast<int>(3 * r(Purpose::lot_style));
  const double width = lot.z1 - lot.z0;
  lot.bays = static_cast<int>(width / (1.9 + 1.3 * r(Purpose::lot_bays)));
  lot.window_width = lot.style == 1 ? 0.88 : 0.42 + 0.2 * r(Purpose::lot_window);
  lot.window_height = lot.style == 2 ? 0.66 : 0.5 + 0.08 * r(Purpose::lot_window_height);
  lot.lit_share = 0.16 + 0.4 * square(r(Purpose::lot_lit));
  lot.wall = (0.75 + 0.5 * r(Purpose::lot_tone)) * pick(walls, r(Purpose::lot_wall));
  const double kind = r(Purpose::lot_shop);
  lot.shop = kind < 0.42 ? Shop::glazed : kind < 0.66 ? Shop::cafe : kind < 0.82 ? Shop::shutter : Shop::entrance;
  constexpr std::array<Vec, 4> lights{Vec{1.55, 1.35, 1.05}, Vec{1.1, 1.45, 1.6}, Vec{1.8, 1.15, 0.55}, Vec{1.7, 1.05, 1.2}};
  lot.shop_light = lot.shop == Shop::cafe ? Vec{1.8, 0.92, 0.32} : pick(lights, r(Purpose::lot_light));
  return lot;
}

/// Words drawn at random for each house would repeat next door, so the list is used in turn from a random start.
template <class List>
std::string_view deal(const City& city, const List& list, Purpose purpose, std::uint64_t turn, std::uint64_t stride) {
  const std::uint64_t start = random_bits(city.seed, 0, purpose) >> 32;
  return list[static_cast<std::size_t>((start + stride * turn) % list.size())];
}

/// A few signs are faulty.
double brightness(const City& city, const Lot& lot) { return city.random(lot.id, Purpose::sign_fault) < 0.07 ? 0.2 : 1; }

void add_fascia(City& city, Lot& lot, double side) {
  const std::string_view text = deal(city, level_words, Purpose::fascia_word, lot.id + lot.id / 20000, 3);
  const double unit = 0.085, width = (6.0 * static_cast<double>(text.size()) - 2) * unit;
  const double middle = 0.5 * (lot.z0 + lot.z1), share = brightness(city, lot);
  if (width > lot.z1 - lot.z0 - 1) return;
  const Vec colour = pick(neon, city.random(lot.id, Purpose::sign_colour));
  lot.fascia = static_cast<int>(city.signs.size());
  const double x = side * lot.front;
  city.signs.push_back({text, 0.8 * colour, false, unit, {{x, 3.36, middle - width / 2 - 0.2}, {x, 4.0, middle + width / 2 + 0.2}}, share});
  city.sources.push_back({{side * (lot.front - 0.35), 3.6, middle}, (0.07 * share * width) * colour, {}, 0, 0, 0.6, false});
}

void add_blade(City& city, const Lot& lot, double side) {
  const std::string_view text = deal(city, upright_words, Purpose::sign_word, lot.id, 4);
  const double unit = 0.11, inner = lot.front - 1.15, outer = lot.front - 0.15;
  const double bottom = 4.4 + 1.2 * city.random(lot.id, Purpose::sign_place);
  const double top = bottom + (8.0 * static_cast<double>(text.size()) - 2 + 4) * unit;
  if (top > lot.height) return;
  const double z = lot.z0 + 0.9, share = brightness(city, lot);
  const Vec colour = pick(neon, city.random(lot.id, Purpose::blade_colour));
  Solid board;
  board.shape = Solid::box;
  board.a = {side > 0 ? inner : -outer, bottom, z - 0.09};
  board.b = {side > 0 ? outer : -inner, top, z + 0.09};
  board.sign = static_cast<int>(city.signs.size());
  city.signs.push_back({text, colour, true, unit, {board.a, board.b}, share});
  city.add(board, city.add_material({{0.02, 0.02, 0.025}, {}, 0.02, false}));
  const Vec centre{side * 0.5 * (inner + outer), 0.5 * (bottom + top), z};
  city.sources.push_back({centre, (0.14 * share * (top - bottom)) * colour, {}, 0, 0, 0.45, true});
}

void add_awning(City& city, const Lot& lot, double side) {
  constexpr std::array<Vec, 4> cloths{Vec{0.25, 0.03, 0.03}, Vec{0.03, 0.13, 0.06}, Vec{0.04, 0.06, 0.16}, Vec{0.3, 0.24, 0.16}};
  const int cloth = city.add_material({pick(cloths, city.random(lot.id, Purpose::awning)), {}, 0.02, false});
  const double depth = 1.25, top = 3.3, drop = 0.55, z0 = lot.z0 + 0.7, z1 = lot.z1 - 0.7;
  const double wall = lot.front, lip = lot.front - depth;
  const Vec slope = unit({-side * drop, depth, 0});
  city.add_convex({{slope, dot(slope, {side * wall, top, 0})},
                   {{0, 0, 1}, z1},
                   {{0, 0, -1}, -z0},
                   {{-side, 0, 0}, -lip},
                   {{side, 0, 0}, wall},
                   {{0, -1, 0}, -(top - drop - 0.2)}},
                  {{min_of(side * lip, side * wall), top - drop - 0.21, z0}, {max_of(side * lip, side * wall), top, z1}}, cloth);
}

}  // namespace

void build_lots(City& city) {
  for (int row = 0; row < 2; ++row) {
    const double side = row == 0 ? -1 : 1;
    std::uint64_t id = 10000 + static_cast<std::uint64_t>(row) * 10000;
    for (double z = -plan::street_end; z < plan::street_end; ++id) {
      Lot lot = draw_lot(city, id, z);
      z = lot.z1;
      if (city.random(id, Purpose::alley) < 0.05) {  // an alley: the building stands far back
        lot.front = plan::facade + 7;
        lot.shop = Shop::entrance;
        lot.z1 = lot.z0 + 3.4;
        z = lot.z1;
      } else {
        const bool open = lot.shop == Shop::glazed || lot.shop == Shop::cafe;
        if (open) {
          const double width = lot.z1 - lot.z0;
          city.sources.push_back({{side * (lot.front - 0.2), 1.9, 0.5 * (lot.z0 + lot.z1)},
                                  (0.8 * width) * lot.shop_light,
                                  {-side, 0, 0},
                                  0.5,
                                  0,
                                  1.2,
                                  false});
        }
        if (lot.shop != Shop::entrance) add_fascia(city, lot, side);
        if (city.random(id, Purpose::blade) < 0.47) add_blade(city, lot, side);
        if (open && city.random(id, Purpose::awning_cover) < 0.45) add_awning(city, lot, side);
      }
      city.lots[static_cast<std::size_t>(row)].push_back(lot);
    }
  }
}

}  // namespace rainref::night_street
