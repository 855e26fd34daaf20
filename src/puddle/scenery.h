// What lies around and under the water, made once for a puddle and shared by the puddles of a process that remembers
// (cache/remembered.h).
#pragma once

#include <array>
#include <memory>

#include "image/texture.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// The environment as passes take it; of the corrected variant also what it sheds on level ground.
struct Sky {
  TextureData environment;
  std::array<float, 3> ambient{};
};
/// The ground tile; of the corrected variant also its slopes.
struct Ground {
  TextureData tile, relief;
};
/// Depths under the water; `shore` is empty where there is none.
struct Bed {
  TextureData depths;
  Image shore;
};

std::shared_ptr<const Sky> sky_of(const Settings& settings, const Surroundings& around, const Rows& rows);
std::shared_ptr<const Ground> ground_of(const Settings& settings, const Surroundings& around, const Rows& rows);
/// Of the corrected variant.
std::shared_ptr<const Bed> bed_of(const Settings& settings);

}  // namespace rainref::puddle
