// A car: its body, its windows, its wheels.
#pragma once

#include "night_street/vec.h"

namespace rainref::night_street {

struct City;

/// Materials shared by the cars of a street.
struct CarMaterials {
  int tyre, arch, rim, trim, lens, reflector, plate, tail;
  explicit CarMaterials(City& city);
};

/// A car centred on (x, 0, z), 4.4 m long and 1.8 m wide. ahead = +1 if it faces +z, -1 if it faces -z. A moving car has its lights on.
void add_car(City& city, const CarMaterials& materials, double x, double z, double ahead, const Vec& paint, bool driving);

/// Whether a point of a cabin's surface lies in a window instead of on roof, pillars or rails: `across` and `along` from the cabin's
/// centre, y above the road, metres; `normal` of the surface.
bool in_window(double across, double y, double along, const Vec& normal);

}  // namespace rainref::night_street
