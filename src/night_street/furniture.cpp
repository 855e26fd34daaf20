// Street lamps, traffic signals and people.
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
      // Most of the left row is old sodium, most of the right row has been replaced.
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
      // Traffic that sees the face comes from its side: it keeps right, so its kerb is at sign(x) = facing.
      const double x = facing * 5.0, z = plan::crossings[i] - facing * (plan::crossing_half_length + 0.7);
      city.add_pole({x, plan::kerb_height, z}, 0.07, 5.9, steel);
      const double tip = facing * 2.0;
      city.add_box({min_of(x, tip), 5.72, z - 0.045}, {max_of(x, tip), 5.82, z + 0.045}, steel);
      add_signal_head(city, {tip, 5.4, z + facing * 0.12}, facing, state, housing);
      add_signal_head(city, {x, 2.9, z + facing * 0.16}, facing, state, housing);
    }
  }
}

void build_walkers(City& city) {
  constexpr std::array<Vec, 5> canopies{Vec{0.02, 0.02, 0.025}, Vec{0.35, 0.03, 0.03}, Vec{0.03, 0.05, 0.10}, Vec{0.40, 0.28, 0.03},
                                        Vec{0.02, 0.02, 0.02}};
  constexpr double diagonal = 0.7071067811865476;
  constexpr std::array<std::array<double, 2>, 8> around{
      {{1, 0}, {diagonal, diagonal}, {0, 1}, {-diagonal, diagonal}, {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}}};
  for (int i = 0; i < 26; ++i) {
    const auto id = static_cast<std::uint64_t>(3000 + i);
    const double side = i % 2 == 0 ? -1 : 1;
    const double x = side * (5.6 + 1.4 * city.random(id, Purpose::walker_place));
    const double z = -150 + 12 * i + 9 * city.random(id, Purpose::walker_stride);
    if (magnitude(z) < 3) continue;  // room for a camera on the pavement near the origin
    const double tone = city.random(id, Purpose::walker_coat);
    const int coat = city.add_material({(0.02 + 0.05 * tone) * Vec{0.9, 1.0, 1.2}, {}, 0.02, false});
    const int skin = city.add_material({{0.25, 0.16, 0.12}, {}, 0, false});
    const double ground = plan::kerb_height;
    city.add_pole({x - 0.09, ground, z + 0.06}, 0.085, 0.8, coat);
    city.add_pole({x + 0.09, ground, z - 0.08}, 0.085, 0.8, coat);
    std::vector<Plane> torso;
    for (const auto& [nx, nz] : around) {
      const Vec normal = unit({nx, 0.22, nz});
      torso.push_back({normal, dot(normal, {x + 0.25 * nx, ground + 0.7, z + 0.25 * nz})});
    }
    torso.push_back({{0, 1, 0}, ground + 1.45});
    torso.push_back({{0, -1, 0}, -(ground + 0.62)});
    city.add_convex(torso, {{x - 0.3, ground + 0.6, z - 0.3}, {x + 0.3, ground + 1.46, z + 0.3}}, coat);
    Solid head;
    head.shape = Solid::sphere;
    head.a = {x, ground + 1.57, z};
    head.b = {0.115, 0, 0};
    city.add(head, skin);
    if (city.random(id, Purpose::umbrella) < 0.25) continue;  // no umbrella
    const auto pick = static_cast<std::size_t>(5 * city.random(id, Purpose::umbrella_colour));
    const int canopy = city.add_material({canopies[pick], {}, 0.03, false});
    const double rim = ground + 1.78, radius = 0.55, rise = 0.26;
    std::vector<Plane> sides;
    for (const auto& [nx, nz] : around) {
      const Vec normal = unit({nx * rise, radius, nz * rise});
      sides.push_back({normal, dot(normal, {x + radius * nx, rim, z + radius * nz})});
    }
    sides.push_back({{0, -1, 0}, -rim});
    city.add_convex(sides, {{x - 0.62, rim - 0.01, z - 0.62}, {x + 0.62, rim + rise + 0.01, z + 0.62}}, canopy);
  }
}

}  // namespace rainref::night_street
