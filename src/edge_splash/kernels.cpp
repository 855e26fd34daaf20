// Shells of splash; compiled once for each SIMD target.
#include "edge_splash/kernels.h"

#include <algorithm>

#define RAINREF_KERNELS "edge_splash/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(edge_splash)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "edge_splash/splash.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

HWY_INLINE HWY_ATTR Channels<Lanes, 4> load_scene(const Image& scene, int x, int y) {
  Lanes in[4];
  load4(scene.row<Half>(y) + 4 * x, in);
  Channels<Lanes, 4> out;
  for (int k = 0; k < 4; ++k) out[k] = in[k];
  return out;
}
HWY_INLINE HWY_ATTR void store_splash(const SplashOutputs& out, const Splash<Lanes>& s, Rounding rounding, int x, int y, int count) {
  store(out.edge->row<Unorm8>(y) + x, s.edge, rounding, count);
  store(out.angle->row<Unorm8>(y) + x, s.angle, rounding, count);
  store(out.noise->row<Unorm8>(y) + x, s.noise, rounding, count);
  const Lanes rgba[4] = {s.colour[0], s.colour[1], s.colour[2], s.colour[3]};
  store4(out.colour->row<Half>(y) + 4 * x, rgba, rounding);
}

void PublishedSplashRows(const PublishedSplashUniforms& uniforms, Rounding rounding, const SplashInputs& in, const SplashOutputs& out, const parallel::Tile& tile) {
  const auto depth = fixed_texture<Address::border, Address::border, 1>(*in.depth), noise = fixed_texture<Address::border, Address::border, 1>(*in.noise_map);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      store_splash(out, splash_as_published<Lanes>(uniforms, depth, noise, load_scene(*in.scene, x, y), x, y), rounding, x, y, std::min(Lanes::size(), tile.x1 - x));
    }
  }
}
void SplashRows(const SplashUniforms& uniforms, Rounding rounding, const SplashInputs& in, const SplashOutputs& out, const parallel::Tile& tile) {
  const auto depth = fixed_texture<Address::clamp, Address::clamp, 1>(*in.depth);
  const auto noise = fixed_texture<Address::repeat, Address::repeat, 1>(*in.noise_map);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Lanes layer = Lanes::load(in.layer->row<Unorm8>(y) + x);
      store_splash(out, splash_corrected<Lanes>(uniforms, depth, noise, layer, load_scene(*in.scene, x, y), x, y), rounding, x, y, std::min(Lanes::size(), tile.x1 - x));
    }
  }
}RAINREF_TARGET_END(edge_splash)

#if RAINREF_ONCE
namespace rainref::edge_splash {

RAINREF_EXPORT(PublishedSplashRows);
RAINREF_EXPORT(SplashRows);

void splash_rows(const PublishedSplashUniforms& uniforms, Rounding rounding, const SplashInputs& in, const SplashOutputs& out, const parallel::Tile& tile) {
  RAINREF_DISPATCH(PublishedSplashRows)(uniforms, rounding, in, out, tile);
}
void splash_rows(const SplashUniforms& uniforms, Rounding rounding, const SplashInputs& in, const SplashOutputs& out, const parallel::Tile& tile) {
  RAINREF_DISPATCH(SplashRows)(uniforms, rounding, in, out, tile);
}

}  // namespace rainref::edge_splash
#endif
