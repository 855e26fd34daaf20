// rain_on_glass in lanes; compiled once for each SIMD target.
#include <algorithm>
#include <concepts>
#include <cstdint>

#include "pass/run.h"
#include "rainy_glass/rain_on_glass.pass.h"

#define RAINREF_KERNELS "rainy_glass/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(rainy_glass)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "image/environment-inl.h"
#include "rainy_glass/rain_on_glass.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

template <bool corrected, class Maps>
HWY_INLINE HWY_ATTR void glass_rows(const RainOnGlassUniforms& u, Rounding rounding, const pass::HostIo<RainOnGlassPass>& host,
                                    const Maps& maps, const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    RainOnGlassPass::Io<LaneCursors> io;
    pass::begin_row<RainOnGlassPass>(host, io, y, rounding);
    const Half* scene = host.scene.image->row<Half>(y);
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      pass::move_to<RainOnGlassPass>(io, x, std::min(Lanes::size(), tile.x1 - x));
      Lanes c[4];
      load4(scene + 4 * x, c);
      give_glass<Lanes, corrected>(u, io, Vec3<Lanes>(c[0], c[1], c[2]), maps, x, y);
    }
  }
}
void RainOnGlassPassRows(const RainOnGlassUniforms& u, bool corrected, Rounding rounding, const pass::HostIo<RainOnGlassPass>& host,
                         const parallel::Tile& tile) {
  const auto rows = [&](const auto& maps) HWY_ATTR {
    corrected ? glass_rows<true>(u, rounding, host, maps, tile) : glass_rows<false>(u, rounding, host, maps, tile);
  };
  // Maps of 8-bit codes hold k / 255, which halves cannot represent, so they were decoded.
  if (host.raindrops.texture && host.rivulets.texture) {
    rows(GlassMaps<Texture, StoredTexture<Half>, StoredTexture<float>>{host.raindrops.texture, host.rivulets.texture, &host.scene.view,
                                                                       &host.near_depth.view, host.probe.texture});
  } else {
    const auto raindrops = stored_texture<Half>(*host.raindrops.recorded->parts.front()),
               rivulets = stored_texture<Half>(*host.rivulets.recorded->parts.front());
    rows(GlassMaps<StoredTexture<Half>, StoredTexture<Half>, StoredTexture<float>>{&raindrops, &rivulets, &host.scene.view,
                                                                                   &host.near_depth.view, host.probe.texture});
  }
}
RAINREF_TARGET_END(rainy_glass)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(rainy_glass, RainOnGlassPass)
#endif
