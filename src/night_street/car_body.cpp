// Cars of convex solids, boxes and discs. Measures in the car's own frame: s sideways, y up, f forward, metres.
#include "night_street/cars.h"
#include "night_street/city.h"

namespace rainref::night_street {

namespace {

constexpr double belt = 0.97, roof_rail = 1.36;             ///< y of the windows' lower and upper edge
constexpr double cabin_lean = 0.42, cabin_offset = 1.166;   ///< sides of the cabin: s + lean y = offset
constexpr double axle_height = 0.315, tyre_radius = 0.315;  ///< wheels stand on the road
constexpr double front_axle = 1.33, rear_axle = -1.32;

struct Car {
  City& city;
  double x, z, ahead;

  Vec at(double s, double y, double f) const { return {x + s, y, z + ahead * f}; }
  /// s, y and f of a plane's normal, not unit, and its offset for that normal.
  Plane side(double s, double y, double f, double offset) const {
    const double scale = 1 / std::sqrt(s * s + y * y + f * f);
    const Vec normal = scale * Vec{s, y, ahead * f};
    return {normal, scale * offset + dot(normal, {x, 0, z})};
  }
  Box around(const Vec& low, const Vec& high) const {
    const double a = z + ahead * low.z, b = z + ahead * high.z;
    return {{x + low.x, low.y, min_of(a, b)}, {x + high.x, high.y, max_of(a, b)}};
  }
  void box(const Vec& low, const Vec& high, int material) const {
    const Box b = around(low, high);
    city.add_box(b.low, b.high, material);
  }
  void disc(double s, double f, double radius, double half_width, int material) const {
    Solid disc;
    disc.shape = Solid::wheel;
    disc.a = at(s, axle_height, f);
    disc.b = {radius, half_width, 0};
    city.add(disc, material);
  }
};

void add_body(const Car& car, int paint, int cabin) {
  car.city.add_convex({car.side(1, 0.10, 0, 0.955),   car.side(-1, 0.10, 0, 0.955), car.side(1, -0.12, 0, 0.834),
                       car.side(-1, -0.12, 0, 0.834),  // flanks
                       car.side(0, 1, 0, 0.98),       car.side(0, 1, 0.142, 1.078), car.side(0, 1, -0.0625, 1.064),
                       car.side(0, -1, 0, -0.2),                                                                 // bonnet, boot
                       car.side(0, 0.15, 1, 2.2825),  car.side(0, 1, 1, 2.87),      car.side(0, -0.6, 1, 1.97),  // nose
                       car.side(0.5, 0, 1, 2.525),    car.side(-0.5, 0, 1, 2.525),  car.side(1, 0, 0.6, 2.02),
                       car.side(-1, 0, 0.6, 2.02),                                                                 // its corners
                       car.side(0, 0.12, -1, 2.272),  car.side(0, 1, -1, 3.04),     car.side(0, -0.5, -1, 2.005),  // tail
                       car.side(0.5, 0, -1, 2.54),    car.side(-0.5, 0, -1, 2.54)},
                      car.around({-0.91, 0.2, -2.2}, {0.91, 0.98, 2.21}), paint);
  car.city.add_convex({car.side(1, cabin_lean, 0, cabin_offset), car.side(-1, cabin_lean, 0, cabin_offset), car.side(0, -1, 0, -0.88),
                       car.side(0, 1, 0.627, 1.525), car.side(0, 1, -0.6, 1.89), car.side(0, 1, 0.10, 1.452), car.side(0, 1, -0.09, 1.482),
                       car.side(0.55, 1, 0, 1.71), car.side(-0.55, 1, 0, 1.71)},
                      car.around({-0.8, 0.88, -1.69}, {0.8, 1.46, 1.03}), cabin);
  for (const double s : {-0.93, 0.93}) car.box({s - 0.09, 0.93, 0.62}, {s + 0.09, 1.06, 0.74}, paint);  // mirrors
}

void add_wheel(const Car& car, const CarMaterials& materials, double sign, double f) {
  // The arch is the upper half of a disc on the flank; below the sill only the tyre is visible.
  std::vector<Plane> arch;
  constexpr double radius = 0.40, diagonal = 0.7071067811865476;
  for (const auto& [y, along] : {std::array{1.0, 0.0},
                                 {diagonal, diagonal},
                                 {diagonal, -diagonal},
                                 {0.0, 1.0},
                                 {0.0, -1.0},
                                 {0.924, 0.383},
                                 {0.924, -0.383},
                                 {0.383, 0.924},
                                 {0.383, -0.924}})
    arch.push_back(car.side(0, y, along, radius + y * axle_height + along * f));
  arch.push_back(car.side(0, -1, 0, -0.22));
  arch.push_back(car.side(sign, 0, 0, 0.908));
  arch.push_back(car.side(-sign, 0, 0, -0.6));
  const double low = min_of(0.6 * sign, 0.908 * sign), high = max_of(0.6 * sign, 0.908 * sign);
  car.city.add_convex(arch, car.around({low, 0.22, f - radius}, {high, axle_height + radius, f + radius}), materials.arch);

  car.disc(sign * 0.80, f, tyre_radius, 0.115, materials.tyre);
  car.disc(sign * 0.80, f, 0.215, 0.119, materials.rim);
  car.disc(sign * 0.80, f, 0.185, 0.122, materials.arch);
  const double face = sign * 0.923, depth = 0.004;
  const double a = min_of(face, face - sign * depth), b = max_of(face, face - sign * depth);
  car.box({a, axle_height - 0.19, f - 0.028}, {b, axle_height + 0.19, f + 0.028}, materials.rim);
  car.box({a, axle_height - 0.028, f - 0.19}, {b, axle_height + 0.028, f + 0.19}, materials.rim);
  car.disc(sign * 0.80, f, 0.065, 0.126, materials.rim);
}

void add_trim(const Car& car, const CarMaterials& m) {
  car.box({-0.87, 0.17, -0.86}, {0.87, 0.29, 0.87}, m.trim);  // sills
  car.box({-0.66, 0.22, 2.0}, {0.66, 0.40, 2.19}, m.trim);    // lower grille
  car.box({-0.40, 0.52, 2.0}, {0.40, 0.63, 2.213}, m.trim);   // grille
  car.box({-0.26, 0.41, 2.0}, {0.26, 0.51, 2.218}, m.plate);
  car.box({-0.26, 0.52, -2.222}, {0.26, 0.63, -2.1}, m.plate);
  car.box({-0.68, 0.22, -2.19}, {0.68, 0.38, -2.0}, m.trim);  // rear bumper
  for (const double s : {-0.53, 0.53}) {
    car.box({s - 0.13, 0.57, 1.9}, {s + 0.13, 0.68, 2.199}, m.lens);
    car.box({s - 0.16, 0.67, -2.194}, {s + 0.16, 0.81, -2.0}, m.reflector);
  }
}

}  // namespace

bool in_window(double across, double y, double along, const Vec& normal) {
  if (normal.y > 0.93 || y < belt || y > roof_rail) return false;
  if (magnitude(normal.x) > 0.7) return magnitude(along + 0.06) > 0.045 && magnitude(along) < 1.12;  // the pillar between the doors
  return magnitude(across) < cabin_offset - cabin_lean * y - 0.055;  // the pillars beside windscreen and rear window
}

CarMaterials::CarMaterials(City& city)
    : tyre(city.add_material({{0.010, 0.010, 0.010}, {}, 0.02, false})),
      arch(city.add_material({{0.003, 0.003, 0.003}, {}, 0, false})),
      rim(city.add_material({{0.22, 0.22, 0.23}, {}, 0.12, false})),
      trim(city.add_material({{0.010, 0.010, 0.011}, {}, 0.02, false})),
      lens(city.add_material({{0.16, 0.17, 0.18}, {}, 0.10, false})),
      reflector(city.add_material({{0.20, 0.010, 0.008}, {}, 0.06, false})),
      plate(city.add_material({{0.42, 0.42, 0.36}, {}, 0.02, false})),
      tail(city.add_material({{}, {3.2, 0.10, 0.05}, 0, false})) {}

void add_car(City& city, const CarMaterials& materials, double x, double z, double ahead, const Vec& paint, bool driving) {
  const Car car{city, x, z, ahead};
  const int body = city.add_material({paint, {}, 0.05, false}), cabin = city.add_material({paint, {}, 0.05, true});
  add_body(car, body, cabin);
  for (const double f : {front_axle, rear_axle})
    for (const double sign : {-1.0, 1.0}) add_wheel(car, materials, sign, f);
  add_trim(car, materials);
  if (!driving) return;
  car.box({-0.5, 0.745, -2.235}, {0.5, 0.77, -2.1}, materials.tail);
  for (const double s : {-0.53, 0.53}) {
    city.add_lamp(car.at(s, 0.625, 2.18), 0.075, {170, 165, 150}, unit({0, -0.06, ahead}), 30, 4);
    city.add_lamp(car.at(s, 0.75, -2.17), 0.06, {26, 0.9, 0.4}, {0, 0, -ahead}, 3, 1);
  }
}

}  // namespace rainref::night_street
