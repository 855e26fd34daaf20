// Cars: two convex solids, four wheels, and the lights of those that drive.
#include "night_street/city.h"

namespace rainref::night_street {

namespace {

/// A car centred on (x, 0, z). ahead = +1 when it faces +z, -1 when it faces -z.
void add_car(City& city, double x, double z, double ahead, const Vec& paint, bool driving) {
  const int body = city.add_material({paint, {}, 0.05, false});
  const int cabin = city.add_material({paint, {}, 0.05, true});
  const int tyre = city.add_material({{0.012, 0.012, 0.012}, {}, 0.02, false});
  // Measures in the car's own frame: s sideways, y up, f forward.
  const auto side = [&](double s, double y, double f, double offset) {
    const double scale = 1 / std::sqrt(s * s + y * y + f * f);
    const Vec normal = scale * Vec{s, y, ahead * f};
    return Plane{normal, scale * offset + dot(normal, {x, 0, z})};
  };
  const Box around{{x - 0.95, 0.1, z - 2.35}, {x + 0.95, 1.5, z + 2.35}};
  city.add_convex({side(1, 0.06, 0, 0.93), side(-1, 0.06, 0, 0.93), side(0, 1, 0, 0.9), side(0, -1, 0, -0.22), side(0, 0.2, 1, 2.28),
                   side(0, 0.12, -1, 2.24), side(0, 1, 0.16, 1.08), side(0, 1, 0.9, 2.45), side(0, 1, -0.8, 2.48)},
                  around, body);
  city.add_convex({side(1, 0.42, 0, 1.16), side(-1, 0.42, 0, 1.16), side(0, 1, 0, 1.42), side(0, -1, 0, -0.85), side(0, 1, 0.62, 1.50),
                   side(0, 1, -0.62, 1.98), side(0, 1, 0.08, 1.45)},
                  around, cabin);
  for (const double f : {1.36, -1.32}) {
    for (const double s : {-0.8, 0.8}) {
      Solid wheel;
      wheel.shape = Solid::wheel;
      wheel.a = {x + s, 0.31, z + ahead * f};
      wheel.b = {0.31, 0.11, 0};
      city.add(wheel, tyre);
    }
  }
  if (!driving) return;
  const int strip = city.add_material({{}, {3.2, 0.10, 0.05}, 0, false});
  const double tail = z - ahead * 2.17;
  city.add_box({x - 0.7, 0.74, tail - 0.03}, {x + 0.7, 0.77, tail + 0.03}, strip);
  for (const double s : {-0.64, 0.64}) {
    city.add_lamp({x + s, 0.64, z + ahead * 2.12}, 0.085, {170, 165, 150}, unit({0, -0.06, ahead}), 30, 4);
    city.add_lamp({x + s, 0.75, tail}, 0.075, {26, 0.9, 0.4}, {0, 0, -ahead}, 3, 1);
  }
}

bool near_crossing(double z, double room) {
  for (const double crossing : plan::crossings) {
    if (magnitude(z - crossing) < room) return true;
  }
  return false;
}

}  // namespace

void build_cars(City& city, bool clear_lane) {
  constexpr std::array<Vec, 6> paints{Vec{0.010, 0.011, 0.013}, Vec{0.22, 0.22, 0.23}, Vec{0.14, 0.008, 0.008},
                                      Vec{0.012, 0.025, 0.07},  Vec{0.35, 0.35, 0.34}, Vec{0.03, 0.035, 0.03}};
  const auto paint_of = [&](std::uint64_t id) { return paints[static_cast<std::size_t>(6 * city.random(id, Purpose::car_paint))]; };
  // Driving cars keep clear of |z| < 10: a camera starts there.
  constexpr std::array<double, 6> away{-15, -38, -70, -150, 22, 75}, oncoming{-31, -54, -92, -190, 16, 110};
  for (std::size_t i = 0; i < away.size(); ++i) {
    const double jitter_away = 3 * city.random(4000 + i, Purpose::car_place);
    const double jitter_oncoming = 5 * city.random(4100 + i, Purpose::car_place);
    if (!clear_lane) add_car(city, 1.95, away[i] - (away[i] < 0 ? jitter_away : -jitter_away), -1, paint_of(4000 + i), true);
    add_car(city, -1.95, oncoming[i] - (oncoming[i] < 0 ? jitter_oncoming : -jitter_oncoming), 1, paint_of(4100 + i), true);
  }
  for (int row = 0; row < 2; ++row) {
    const double direction = row == 0 ? 1 : -1;
    for (int k = -24; k <= 24; ++k) {
      const auto id = static_cast<std::uint64_t>(4500 + row * 100 + k);
      const double z = 6.2 * k + 0.5 * city.random(id, Purpose::car_place);
      if (magnitude(z) < 9 || near_crossing(z, 8) || city.random(id, Purpose::car_present) < 0.62) continue;
      add_car(city, -direction * 3.55, z, direction, paint_of(id), false);
    }
  }
}

}  // namespace rainref::night_street
