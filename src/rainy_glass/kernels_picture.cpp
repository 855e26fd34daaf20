// Shell of rain_on_glass; compiled once for each SIMD target.
#include <concepts>
#include <cstdint>

#include "rainy_glass/kernels.h"

#define RAINREF_KERNELS "rainy_glass/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

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

template <class Maps>
HWY_INLINE HWY_ATTR void glass_rows(const RainOnGlassUniforms& uniforms, bool corrected, Rounding rounding, const GlassInputs& in, const Maps& maps, Image& colour, const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      Lanes s[4], n[4], c[4];
      load4(in.surface->row<float>(y) + 4 * x, s);
      load4(in.orientation->row<Half>(y) + 4 * x, n);
      load4(in.own->row<Half>(y) + 4 * x, c);
      const Lanes depth = corrected ? Lanes::load(in.depth->row<float>(y) + x) : Lanes(0.0f);
      const GlassPixel<Lanes> p{s[0], s[1], s[2], n[3], Vec3<Lanes>(n[0], n[1], n[2]), Vec3<Lanes>(c[0], c[1], c[2]), depth};
      const Vec3<Lanes> seen = corrected ? rain_on_glass_corrected<Lanes>(uniforms, maps, p, x, y) : rain_on_glass_as_published<Lanes>(uniforms, maps, p, x, y);
      const Lanes rgba[4] = {seen.x, seen.y, seen.z, Lanes(1.0f)};
      store4(colour.row<Half>(y) + 4 * x, rgba, rounding);
    }
  }
}
void RainOnGlassRows(const RainOnGlassUniforms& uniforms, bool corrected, Rounding rounding, const GlassInputs& in, Image& colour, const parallel::Tile& tile) {
  const auto scene = stored_texture<Half>(*in.own);
  const auto near_depth = corrected ? stored_texture<float>(*in.near_depth) : StoredTexture<float>();
  // Two maps of codes hold k / 255, which no half is.
  if (in.raindrops->format() == Format::rgba16f && in.rivulets->format() == Format::rgba16f) {
    const auto raindrops = stored_texture<Half>(*in.raindrops), rivulets = stored_texture<Half>(*in.rivulets);
    glass_rows(uniforms, corrected, rounding, in, GlassMaps<StoredTexture<Half>, StoredTexture<Half>, StoredTexture<float>>{&raindrops, &rivulets, &scene, &near_depth, in.probe}, colour, tile);
  } else {
    glass_rows(uniforms, corrected, rounding, in, GlassMaps<Texture, StoredTexture<Half>, StoredTexture<float>>{in.raindrop_texture, in.rivulet_texture, &scene, &near_depth, in.probe}, colour, tile);
  }
}
RAINREF_TARGET_END(rainy_glass)

#if RAINREF_ONCE
namespace rainref::rainy_glass {

RAINREF_EXPORT(RainOnGlassRows);

void rain_on_glass_rows(const RainOnGlassUniforms& uniforms, bool corrected, Rounding rounding, const GlassInputs& in, Image& colour, const parallel::Tile& tile) {
  RAINREF_DISPATCH(RainOnGlassRows)(uniforms, corrected, rounding, in, colour, tile);
}

}  // namespace rainref::rainy_glass
#endif
