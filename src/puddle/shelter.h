// Where a roof keeps the rain off: the share of the drops that fall, over the water's rectangle.
#pragma once

#include <string_view>
#include <vector>

#include "puddle/uniforms.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// A roof over [x0, x1] x [z0, z1], world [m].
struct Roof {
  double x0, z0, x1, z1;
};
/// "x0 z0 x1 z1; ..." Throws Error(usage), naming the roof and the key rain.shelter, for any other text, more than 64 roofs, and corners in
/// the other order or beyond 10 km.
std::vector<Roof> parse_roofs(std::string_view text);

/// In how many of 65536 drops over a cell one falls; row-major, row 0 = lowest z. None: everywhere all of them.
struct Shelter {
  int columns = 0, rows = 0;
  std::vector<ShelterCell> cells;
};
/// Of rain.shelter: cells of the wave's grid, each by the share of it that no roof covers (of roofs that overlap in a cell which both
/// cover in part, less). Of a picture (Surroundings::shelter): its texels, rounded to the nearest. Throws Error(usage) for both.
Shelter shelter_of(const Settings& settings, const Image& picture);

}  // namespace rainref::puddle
