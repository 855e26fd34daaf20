// Shells of background and drops; compiled once for each SIMD target.
#include "screen_drops/kernels.h"

#include <algorithm>
#include <concepts>
#include <cstdint>

#define RAINREF_KERNELS "screen_drops/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(screen_drops)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "screen_drops/background.pass.h"
#include "math/in_parts-inl.h"
#include "screen_drops/drops.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

HWY_INLINE HWY_ATTR void store_colour(Half* to, const Vec3<Lanes>& c, Rounding rounding) {
  const Lanes rgba[4] = {c.x, c.y, c.z, Lanes(1.0f)};
  store4(to, rgba, rounding);
}
HWY_INLINE HWY_ATTR Vec3<Lanes> load_colour(const Half* from) {
  Lanes c[4];
  load4(from, c);
  return Vec3<Lanes>(c[0], c[1], c[2]);
}

void BackgroundRows(const BackgroundUniforms& uniforms, bool corrected, Rounding rounding, const StoredTexture<Half>& scene, std::span<const Tap> taps, Image& background, const parallel::Tile& tile) {
  const auto pyramid = fixed_texture<Address::clamp, Address::clamp, 4>(scene);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      store_colour(background.row<Half>(y) + 4 * x,
                   corrected ? background_corrected<Lanes>(uniforms, pyramid, taps.data(), x, y) : background_as_published<Lanes>(uniforms, pyramid, x, y), rounding);
    }
  }
}

template <class Pass>
HWY_INLINE HWY_ATTR void window_rows(Rounding rounding, const Image& background, Image& water, Image& colour, const parallel::Tile& tile, const Pass& pass) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Window<Lanes> w = pass(load_colour(background.row<Half>(y) + 4 * x), x, y);
      store(water.row<Unorm8>(y) + x, w.water, rounding, std::min(Lanes::size(), tile.x1 - x));
      store_colour(colour.row<Half>(y) + 4 * x, w.colour, rounding);
    }
  }
}
void PublishedDropsRows(const PublishedDropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile) {
  const auto scene = fixed_texture<Address::clamp, Address::clamp, 4>(in.scene);
  const auto noise = fixed_texture<Address::repeat, Address::repeat, 4>(*in.noise);
  window_rows(rounding, *in.background, water, colour, tile,
              [&](const Vec3<Lanes>& below, int x, int y) HWY_ATTR __attribute__((always_inline)) { return drops_as_published<Lanes>(uniforms, scene, noise, below, x, y); });
}
void DropsRows(const DropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile) {
  const auto scene = fixed_texture<Address::clamp, Address::clamp, 4>(in.scene);
  const auto cells = fixed_texture<Address::clamp, Address::clamp, 4>(in.cells);
  const auto height = fixed_texture<Address::clamp, Address::clamp, 1>(in.height);
  window_rows(rounding, *in.background, water, colour, tile,
              [&](const Vec3<Lanes>& below, int x, int y) HWY_ATTR __attribute__((always_inline)) { return drops_corrected<Lanes>(uniforms, scene, cells, height, below, x, y); });
}
RAINREF_TARGET_END(screen_drops)

#if RAINREF_ONCE
namespace rainref::screen_drops {

RAINREF_EXPORT(BackgroundRows);
RAINREF_EXPORT(PublishedDropsRows);
RAINREF_EXPORT(DropsRows);

void background_rows(const BackgroundUniforms& uniforms, bool corrected, Rounding rounding, const StoredTexture<Half>& scene, std::span<const Tap> taps, Image& background, const parallel::Tile& tile) {
  RAINREF_DISPATCH(BackgroundRows)(uniforms, corrected, rounding, scene, taps, background, tile);
}
void drops_rows(const PublishedDropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile) {
  RAINREF_DISPATCH(PublishedDropsRows)(uniforms, rounding, in, water, colour, tile);
}
void drops_rows(const DropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile) {
  RAINREF_DISPATCH(DropsRows)(uniforms, rounding, in, water, colour, tile);
}

}  // namespace rainref::screen_drops
#endif
