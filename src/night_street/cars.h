// A car: its body, its windows, its wheels.
#pragma once

#include "night_street/vec.h"

namespace rainref::night_street {

struct City;

/// What the cars of a street share.
struct CarMaterials {
  int tyre, arch, rim, trim, lens, reflector, plate, tail;
  explicit CarMaterials(City& city);
};

/// A car centred on (x, 0, z), 4.4 m long and 1.8 m wide. ahead = +1 when it faces +z, -1 when it faces -z. One that drives has its lights
/// on.
void add_car(City& city, const CarMaterials& materials, double x, double z, double ahead, const Vec& paint, bool driving);

/// Whether a point of a cabin's surface lies in one of its windows rather than on roof, pillars or rails: `across` and `along` from the
/// cabin's middle, y above the road, metres; `normal` the surface's.
bool in_window(double across, double y, double along, const Vec& normal);

}  // namespace rainref::night_street
