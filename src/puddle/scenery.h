// The surroundings and the bed of the water, shared by all puddles of a process with the same settings (cache/prepared.h).
#pragma once

#include <array>
#include <memory>

#include "cache/prepared.h"
#include "image/texture.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// The environment as passes take it; for corrected also its light on level ground.
struct Sky {
  TextureData environment;
  std::array<float, 3> ambient{};
  std::size_t bytes() const { return environment.bytes(); }
};
/// The ground tile; for corrected also its slopes.
struct Ground {
  TextureData tile, relief;
  std::size_t bytes() const { return tile.bytes() + relief.bytes(); }
};
/// Depths under the water; `shore` is empty if there is none.
struct Bed {
  TextureData depths;
  Image shore;
  std::size_t bytes() const { return depths.bytes() + cache::bytes_of(shore); }
};

std::shared_ptr<const Sky> sky_of(const Settings& settings, const Surroundings& around, const Rows& rows);
std::shared_ptr<const Ground> ground_of(const Settings& settings, const Surroundings& around, const Rows& rows);
/// For the corrected variant.
std::shared_ptr<const Bed> bed_of(const Settings& settings);

/// The environment for shade. as-published: display-encoded; a linear picture is encoded by the power 1/2.2, which the pass inverts.
/// corrected: linear with mips. Cube faces in a row are put into a column.
TextureData prepare_environment(const Image& environment, bool is_cube, bool is_encoded, Variant variant, const Rows& rows = rows_here);
/// The ground tile, likewise; for corrected with mips.
TextureData prepare_ground(const Image& ground, bool is_encoded, Variant variant, const Rows& rows = rows_here);

/// Radiance of white diffuse level ground under the environment: (1/pi) integral of L cos(theta) over the upper half of directions.
std::array<float, 3> ambient_radiance(const Texture& environment, bool is_cube);

}  // namespace rainref::puddle
