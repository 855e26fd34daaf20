// Positions of moving and parked cars.
#include "night_street/cars.h"

#include "night_street/city.h"

namespace rainref::night_street {

namespace {

bool near_crossing(double z, double room) {
  for (const double crossing : plan::crossings) {
    if (magnitude(z - crossing) < room) return true;
  }
  return false;
}

}  // namespace

void build_cars(City& city, bool clear_lane) {
  const CarMaterials materials(city);
  constexpr std::array<Vec, 6> paints{Vec{0.010, 0.011, 0.013}, Vec{0.22, 0.22, 0.23}, Vec{0.14, 0.008, 0.008},
                                      Vec{0.012, 0.025, 0.07},  Vec{0.35, 0.35, 0.34}, Vec{0.03, 0.035, 0.03}};
  const auto paint_of = [&](std::uint64_t id) { return paints[static_cast<std::size_t>(6 * city.random(id, Purpose::car_paint))]; };
  // Moving cars keep clear of |z| < 10, where a camera starts.
  constexpr std::array<double, 6> away{-15, -38, -70, -150, 22, 75}, oncoming{-31, -54, -92, -190, 16, 110};
  for (std::size_t i = 0; i < away.size(); ++i) {
    const double jitter_away = 3 * city.random(4000 + i, Purpose::car_place);
    const double jitter_oncoming = 5 * city.random(4100 + i, Purpose::car_place);
    if (!clear_lane) add_car(city, materials, 1.95, away[i] - (away[i] < 0 ? jitter_away : -jitter_away), -1, paint_of(4000 + i), true);
    add_car(city, materials, -1.95, oncoming[i] - (oncoming[i] < 0 ? jitter_oncoming : -jitter_oncoming), 1, paint_of(4100 + i), true);
  }
  for (int row = 0; row < 2; ++row) {
    const double direction = row == 0 ? 1 : -1;
    for (int k = -24; k <= 24; ++k) {
      const auto id = static_cast<std::uint64_t>(4500 + row * 100 + k);
      const double z = 6.2 * k + 0.5 * city.random(id, Purpose::car_place);
      if (magnitude(z) < 9 || near_crossing(z, 8) || city.random(id, Purpose::car_present) < 0.62) continue;
      add_car(city, materials, -direction * 3.55, z, direction, paint_of(id), false);
    }
  }
}

}  // namespace rainref::night_street
