// Street lamps and traffic signals.
#include "night_street/city.h"

namespace rainref::night_street {

namespace {

constexpr Vec sodium{1.0, 0.50, 0.13};
constexpr Vec white{0.82, 0.92, 1.0};
constexpr Vec dark_steel{0.03, 0.03, 0.035};

/// One lamp post of the row at sign(x) = side, with its arm over the road.
void add_street_lamp(City& city, double side, double z, const Vec& radiance, int steel) {
  constexpr double post = 5.2, head = 3.3, height = 7.4;
  city.add_pole({side * post, plan::kerb_height, z}, 0.075, height - 0.1, steel);
  city.add_pole({side * post, plan::kerb_height, z}, 0.13, 1.1, steel);
  const double inner = side * (head - 0.35), outer = side * (post + 0.08);
  city.add_box({min_of(inner, outer), height - 0.06, z - 0.05}, {max_of(inner, outer), height + 0.04, z + 0.05}, steel);
  const double hood = side * head;
  city.add_box({hood - 0.42, height - 0.05, z - 0.17}, {hood + 0.42, height + 0.09, z + 0.17}, steel);
  city.add_lamp({hood, height - 0.14, z}, 0.17, radiance, {0, -1, 0}, 3.5, 1);
}

/// A head of three signals that faces along z; state 0 red, 1 amber, 2 green.
void add_signal_head(City& city, const Vec& centre, double facing, int state, int housing) {
  city.add_box(centre - Vec{0.16, 0.48, 0.1}, centre + Vec{0.16, 0.48, 0.1}, housing);
  constexpr std::array<Vec, 3> colours{Vec{42, 1.6, 0.9}, Vec{38, 15, 0.8}, Vec{1.2, 30, 15}};
  for (int i = 0; i < 3; ++i) {
    const Vec disc = centre + Vec{0, 0.3 - 0.3 * i, facing * 0.06};
    if (i == state) {
      city.add_lamp(disc, 0.105, colours[static_cast<std::size_t>(i)], {0, 0, facing}, 2, 2);
    } else {
      Solid off;
      off.shape = Solid::sphere;
      off.a = disc;
      off.b = {0.1, 0, 0};
      city.add(off, housing);
    }
  }
}

}  // namespace

void build_lamps(City& city) {
  const int steel = city.add_material({dark_steel, {}, 0.03, false});
  for (int row = 0; row < 2; ++row) {
    const double side = row == 0 ? -1 : 1;
    for (int k = -11; k <= 11; ++k) {
      const auto id = static_cast<std::uint64_t>(1000 + row * 100 + k);
      const double z = (row == 0 ? -8 : 5) + 26.0 * k + 1.2 * (city.random(id, Purpose::lamp_offset) - 0.5);
      // Most lamps of the left row are old sodium lamps; most of the right row have been replaced.
      const bool is_sodium = city.random(id, Purpose::lamp_kind) < (row == 0 ? 0.85 : 0.35);
      add_street_lamp(city, side, z, is_sodium ? 170.0 * sodium : 130.0 * white, steel);
    }
  }
}

void build_signals(City& city) {
  const int steel = city.add_material({dark_steel, {}, 0.03, false});
  const int housing = city.add_material({{0.012, 0.013, 0.012}, {}, 0.03, false});
  for (std::size_t i = 0; i < plan::crossings.size(); ++i) {
    const int state = city.random(2000 + i, Purpose::signal_state) < 0.5 ? 0 : 2;
    for (const double facing : {1.0, -1.0}) {
      // Traffic that sees the face comes from its side; it keeps right, so its kerb is at sign(x) = facing.
      const double x = facing * 5.0, z = plan::crossings[i] - facing * (plan::crossing_half_length + 0.7);
      city.add_pole({x, plan::kerb_height, z}, 0.07, 5.9, steel);
      const double tip = facing * 2.0;
      city.add_box({min_of(x, tip), 5.72, z - 0.045}, {max_of(x, tip), 5.82, z + 0.045}, steel);
      add_signal_head(city, {tip, 5.4, z + facing * 0.12}, facing, state, housing);
      add_signal_head(city, {x, 2.9, z + facing * 0.16}, facing, state, housing);
    }
  }
}

}  // namespace rainref::night_street
