// background and drops in lanes; compiled once for each SIMD target.
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstring>

#include "pass/run.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/drops.pass.h"
#include "screen_drops/reach.h"

#define RAINREF_KERNELS "screen_drops/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

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

RAINREF_PASS_ROWS(BackgroundPass)
RAINREF_PASS_ROWS(PublishedDropsPass)

// drops_corrected in two halves: the water of every pixel, then the scene behind the wet ones.
void DropsPassRows(const DropsUniforms& uniforms, bool, Rounding rounding, const pass::HostIo<DropsPass>& io, const parallel::Tile& tile) {
  const auto scene = fixed_texture<Address::clamp, Address::clamp, 4>(io.scene.view);
  const auto cells = fixed_texture<Address::clamp, Address::clamp, 4>(io.cells.view);
  const auto height = fixed_texture<Address::clamp, Address::clamp, 1>(io.height.view);
  PackedLanes<5> wet;
  Reach reach(uniforms, io.cells.view, io.height.view, tile.x1, Lanes::size());
  for (int y = tile.y0; y < tile.y1; ++y) {
    reach.enter_row(y);
    const Half* below = io.background.image->row<Half>(y);
    Half* out = io.colour.image->row<Half>(y);
    std::memcpy(out + 4 * tile.x0, below + 4 * tile.x0, static_cast<std::size_t>(tile.x1 - tile.x0) * texel_bytes);
    const auto show = [&]() HWY_ATTR {
      wet.drain([&](const Lanes(&n)[5], const std::int32_t* columns, int count) HWY_ATTR __attribute__((always_inline)) {
        Half texels[4 * Lanes::size()] = {};
        for (int k = 0; k < count; ++k) std::memcpy(texels + 4 * k, below + 4 * columns[k], texel_bytes);
        store_colour(texels,
                     behind_water(uniforms, scene, Surface<Lanes>{n[0], n[1], n[2], n[3]}, load_colour(texels), n[4],
                                  Lanes(static_cast<float>(y) + 0.5f)),
                     rounding);
        for (int k = 0; k < count; ++k) std::memcpy(out + 4 * columns[k], texels + 4 * k, texel_bytes);
      });
    };
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Surface<Lanes> s = water_at<Lanes>(uniforms, cells, height, x, y, reach.of(x / Lanes::size()));
      store(io.water.image->row<Unorm8>(y) + x, s.cover, rounding, std::min(Lanes::size(), tile.x1 - x));
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
RAINREF_PASS_DISPATCH(screen_drops, BackgroundPass)
RAINREF_PASS_DISPATCH(screen_drops, PublishedDropsPass)
RAINREF_PASS_DISPATCH(screen_drops, DropsPass)
#endif
