// The shells of the bakes: rows of texels in, rows of texels out, for the SIMD target in use. They load, call the pass and
// store; they know no arithmetic.
#pragma once

#include <span>

#include "rainref/texture.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainy_glass/uniforms.h"

namespace rainref::rainy_glass {

/// Writes a tile of the map, rgba8 or rgba16f, from droplets that may matter there, in the order of the list.
void bake_raindrops_rows(const BakeRaindropsUniforms& uniforms, bool corrected, Rounding rounding, std::span<const Droplet> droplets,
                         Image& map, const parallel::Tile& tile);
/// lattice: rgba32f gradients, 2 flow_cells a side.
void bake_rivulets_rows(const BakeRivuletsUniforms& uniforms, Rounding rounding, std::span<const Trail> trails, const Texture& lattice,
                        Image& map, const parallel::Tile& tile);

}  // namespace rainref::rainy_glass
