// Shells of background and drops; compiled once for each SIMD target.
#include "screen_drops/kernels.h"

#include "screen_drops/reach.h"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstring>

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
#include "math/packed_lanes-inl.h"
#include "screen_drops/drops.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

constexpr std::size_t texel_bytes = 4 * sizeof(Half);

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

void PublishedDropsRows(const PublishedDropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile) {
  const auto scene = fixed_texture<Address::clamp, Address::clamp, 4>(in.scene);
  const auto noise = fixed_texture<Address::repeat, Address::repeat, 4>(*in.noise);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Window<Lanes> w = drops_as_published<Lanes>(uniforms, scene, noise, load_colour(in.background->row<Half>(y) + 4 * x), x, y);
      store(water.row<Unorm8>(y) + x, w.water, rounding, std::min(Lanes::size(), tile.x1 - x));
      store_colour(colour.row<Half>(y) + 4 * x, w.colour, rounding);
    }
  }
}
// drops_corrected with its two halves apart: the water of every pixel, then what lies behind that of those which are wet.
void DropsRows(const DropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile) {
  const auto scene = fixed_texture<Address::clamp, Address::clamp, 4>(in.scene);
  const auto cells = fixed_texture<Address::clamp, Address::clamp, 4>(in.cells);
  const auto height = fixed_texture<Address::clamp, Address::clamp, 1>(in.height);
  PackedLanes<5> wet;
  Reach reach(uniforms, in.cells, in.height, tile.x1, Lanes::size());
  for (int y = tile.y0; y < tile.y1; ++y) {
    reach.enter_row(y);
    const Half* below = in.background->row<Half>(y);
    Half* out = colour.row<Half>(y);
    std::memcpy(out + 4 * tile.x0, below + 4 * tile.x0, static_cast<std::size_t>(tile.x1 - tile.x0) * texel_bytes);
    const auto show = [&]() HWY_ATTR {
      wet.drain([&](const Lanes(&n)[5], const std::int32_t* columns, int count) HWY_ATTR __attribute__((always_inline)) {
        Half texels[4 * Lanes::size()] = {};
        for (int k = 0; k < count; ++k) std::memcpy(texels + 4 * k, below + 4 * columns[k], texel_bytes);
        store_colour(texels, behind_water(uniforms, scene, Surface<Lanes>{n[0], n[1], n[2], n[3]}, load_colour(texels), n[4], Lanes(static_cast<float>(y) + 0.5f)), rounding);
        for (int k = 0; k < count; ++k) std::memcpy(out + 4 * columns[k], texels + 4 * k, texel_bytes);
      });
    };
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Surface<Lanes> s = water_at<Lanes>(uniforms, cells, height, x, y, reach.of(x / Lanes::size()));
      store(water.row<Unorm8>(y) + x, s.cover, rounding, std::min(Lanes::size(), tile.x1 - x));
      const auto is_wet = s.cover > Lanes(0.0f);
      if (!any(is_wet)) continue;
      const Lanes column = Lanes::index(x);
      wet.push(is_wet & (column < Lanes(static_cast<float>(tile.x1))), {s.x, s.y, s.cover, s.level, column + Lanes(0.5f)}, x);
      if (wet.is_full()) show();
    }
    show();
  }
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
