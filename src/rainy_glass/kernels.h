// The shells of the passes: rows of texels in, rows of texels out, for the SIMD target in use. They load, call the pass and
// store; they know no arithmetic.
#pragma once

#include <span>

#include "image/stored_texture.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainy_glass/uniforms.h"

namespace rainref::rainy_glass {

/// Writes a tile of the map, rgba8 or rgba16f, from droplets that may matter there, in the order of the list.
void bake_raindrops_rows(const BakeRaindropsUniforms& uniforms, bool corrected, Rounding rounding, std::span<const Droplet> droplets, Image& map, const parallel::Tile& tile);
/// lattice: rgba32f gradients, 2 flow_cells a side.
void bake_rivulets_rows(const BakeRivuletsUniforms& uniforms, Rounding rounding, std::span<const Trail> trails, const Texture& lattice, Image& map, const parallel::Tile& tile);

struct GlassInputs {
  const Image *raindrops, *rivulets;            ///< rgba8 or rgba16f
  const Texture *raindrop_texture, *rivulet_texture;  ///< of the same; needed of rgba8
  const Image* near_depth;                      ///< r32f; corrected
  const Texture* probe;                         ///< with use_probe
  const Image *surface, *orientation, *own, *depth;  ///< own: the scene, rgba16f; depth: corrected
};
/// colour: rgba16f, alpha 1.
void rain_on_glass_rows(const RainOnGlassUniforms& uniforms, bool corrected, Rounding rounding, const GlassInputs& in, Image& colour, const parallel::Tile& tile);

}  // namespace rainref::rainy_glass
