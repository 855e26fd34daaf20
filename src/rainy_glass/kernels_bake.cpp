// Shells of the bakes; compiled once for each SIMD target.
#include <algorithm>

#include "rainy_glass/kernels.h"

#define RAINREF_KERNELS "rainy_glass/kernels_bake.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(rainy_glass)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "rainy_glass/bake.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

HWY_INLINE void store_map(Image& map, int x, int y, const Baked<Lanes>& b, Rounding rounding, int count) {
  const Lanes rgba[4] = {b.r, b.g, b.b, b.a};
  if (map.format() == Format::rgba8 && count == Lanes::size()) return store4(map.row<Unorm8>(y) + 4 * x, rgba, rounding);
  if (map.format() == Format::rgba16f && count == Lanes::size()) return store4(map.row<Half>(y) + 4 * x, rgba, rounding);
  // The tile to the right belongs to another thread.
  if (map.format() == Format::rgba8) {
    HWY_ALIGN Unorm8 texels[4 * HWY_MAX_BYTES];
    store4(texels, rgba, rounding);
    for (int k = 0; k < 4 * count; ++k) map.row<Unorm8>(y)[4 * x + k] = texels[k];
  } else {
    HWY_ALIGN Half texels[4 * HWY_MAX_BYTES];
    store4(texels, rgba, rounding);
    for (int k = 0; k < 4 * count; ++k) map.row<Half>(y)[4 * x + k] = texels[k];
  }
}

void BakeRaindropsRows(const BakeRaindropsUniforms& uniforms, bool corrected, Rounding rounding, std::span<const Droplet> droplets,
                       Image& map, const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      store_map(map, x, y, bake_raindrops<Lanes>(uniforms, corrected, droplets.data(), static_cast<int>(droplets.size()), x, y), rounding,
                std::min(Lanes::size(), tile.x1 - x));
    }
  }
}

void BakeRivuletsRows(const BakeRivuletsUniforms& uniforms, Rounding rounding, std::span<const Trail> trails, const Texture& lattice,
                      Image& map, const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      store_map(map, x, y, bake_rivulets<Lanes>(uniforms, trails.data(), static_cast<int>(trails.size()), lattice, x, y), rounding,
                std::min(Lanes::size(), tile.x1 - x));
    }
  }
}
RAINREF_TARGET_END(rainy_glass)

#if RAINREF_ONCE
namespace rainref::rainy_glass {

RAINREF_EXPORT(BakeRaindropsRows);
RAINREF_EXPORT(BakeRivuletsRows);

void bake_raindrops_rows(const BakeRaindropsUniforms& uniforms, bool corrected, Rounding rounding, std::span<const Droplet> droplets,
                         Image& map, const parallel::Tile& tile) {
  RAINREF_DISPATCH(BakeRaindropsRows)(uniforms, corrected, rounding, droplets, map, tile);
}
void bake_rivulets_rows(const BakeRivuletsUniforms& uniforms, Rounding rounding, std::span<const Trail> trails, const Texture& lattice,
                        Image& map, const parallel::Tile& tile) {
  RAINREF_DISPATCH(BakeRivuletsRows)(uniforms, rounding, trails, lattice, map, tile);
}

}  // namespace rainref::rainy_glass
#endif
