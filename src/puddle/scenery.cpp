#include "puddle/scenery.h"

#include "cache/kept_images.h"
#include "cache/remembered.h"
#include "puddle/environment.h"
#include "puddle/ground.h"

namespace rainref::puddle {
namespace {

/// What a process remembers of these; never destroyed, as threads may outlive static objects.
template <class T>
cache::Remembered<T>& remembered() {
  static cache::Remembered<T>& all = *new cache::Remembered<T>;
  return all;
}

/// The name of what is made of a picture; "" where nothing is remembered: hashing it would cost for nothing.
std::string named(cache::Recipe recipe, const Image& image) { return cache::remembered_bytes() == 0 ? "" : recipe.add(image).text(); }

std::size_t bytes_of(const TextureData& texture) {
  const Texture& t = texture.view();
  if (t.levels == 0) return 0;
  const int last = t.levels - 1;
  return sizeof(float) * static_cast<std::size_t>(t.channels) *
         (static_cast<std::size_t>(t.offset[last]) + static_cast<std::size_t>(t.width[last]) * static_cast<std::size_t>(t.height[last]));
}

}  // namespace

std::shared_ptr<const Sky> sky_of(const Settings& s, const Surroundings& around, const Rows& rows) {
  const bool corrected = s.variant == Variant::corrected;
  cache::Recipe recipe("puddle sky");
  recipe.add(std::uint64_t{corrected}).add(std::uint64_t{around.environment_is_cube}).add(std::uint64_t{around.environment_is_encoded});
  return remembered<Sky>().get(
      named(recipe, around.environment), [](const Sky& sky) { return bytes_of(sky.environment); },
      [&] {
        Sky sky{prepare_environment(around, s.variant, rows), {}};
        if (corrected) sky.ambient = ambient_radiance(sky.environment.view(), around.environment_is_cube);
        return sky;
      });
}

std::shared_ptr<const Ground> ground_of(const Settings& s, const Surroundings& around, const Rows& rows) {
  const bool corrected = s.variant == Variant::corrected, is_own = around.ground.empty();
  // A checkerboard hides the ground image of as-published; the corrected ground has relief all the same.
  const bool is_hidden = is_own && !corrected && s.use_checkerboard;
  cache::Recipe recipe("puddle ground");
  recipe.add(std::uint64_t{corrected}).add(std::uint64_t{is_own}).add(std::uint64_t{is_hidden}).add(is_own ? s.seed : 0);
  recipe.add(std::uint64_t{around.ground_is_encoded});
  return remembered<Ground>().get(
      named(recipe, around.ground), [](const Ground& ground) { return bytes_of(ground.tile) + bytes_of(ground.relief); },
      [&] {
        const Image made = !is_own ? Image() : is_hidden ? Image(Format::rgba32f, 1, 1) : make_asphalt(s.seed);
        Ground ground{prepare_ground(is_own ? made : around.ground, is_own ? false : around.ground_is_encoded, s.variant, rows), {}};
        if (corrected) ground.relief = make_relief(ground.tile, is_own, rows);
        return ground;
      });
}

std::shared_ptr<const Bed> bed_of(const Settings& s) {
  const bool is_natural = s.shape == Shape::natural;
  cache::Recipe recipe("puddle bed");
  recipe.add(std::uint64_t{is_natural}).add(is_natural ? s.seed : 0);
  recipe.add({static_cast<double>(s.grid[0]), static_cast<double>(s.grid[1]), s.cell_size, s.puddle_depth,
              static_cast<double>(s.bed_columns), s.shore_width});
  return remembered<Bed>().get(
      recipe.text(),
      [](const Bed& bed) {
        return bytes_of(bed.depths) +
               (bed.shore.empty() ? 0 : Image::memory_bytes(bed.shore.format(), bed.shore.width(), bed.shore.height()));
      },
      [&] {
        Bed bed{make_bed(s), {}};
        if (is_natural) bed.shore = make_shore(s, bed.depths.view());
        return bed;
      });
}

}  // namespace rainref::puddle
