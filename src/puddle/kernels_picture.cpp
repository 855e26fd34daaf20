// Shells of surface_hit, ground_noise, shade and display; compiled once for each SIMD target.
#include <algorithm>

#include "puddle/kernels.h"

#define RAINREF_KERNELS "puddle/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/environment-inl.h"
#include "puddle/surface_hit.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

void SurfaceHitRows(const SurfaceHitUniforms& uniforms, bool corrected, Rounding rounding, const Texture& wave, const Texture& bounds,
                    Image& hit, Image& normal, const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const SurfaceHit<Lanes> s = corrected ? surface_hit_corrected<Lanes>(uniforms, wave, bounds, x, y)
                                            : surface_hit_as_published<Lanes>(uniforms, wave, x, y);
      const Lanes position[4] = {s.position.x, s.position.y, s.position.z, s.iterations};
      const Lanes direction[4] = {s.normal.x, s.normal.y, s.normal.z, s.flag};
      store4(hit.row<float>(y) + 4 * x, position, rounding);
      store4(normal.row<Half>(y) + 4 * x, direction, rounding);
    }
  }
}

HWY_INLINE Surface<Lanes> load_surface(const Image& hit, const Image& normal, int x, int y) {
  Lanes p[4], n[4];
  load4(hit.row<float>(y) + 4 * x, p);
  load4(normal.row<Half>(y) + 4 * x, n);
  return {Vec3<Lanes>(p[0], p[1], p[2]), Vec3<Lanes>(n[0], n[1], n[2]), n[3]};
}

void GroundNoiseRows(const GroundNoiseUniforms& uniforms, Rounding rounding, const Image& hit, const Image& normal, Image& noise,
                     const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Lanes value = ground_noise_as_published<Lanes>(uniforms, load_surface(hit, normal, x, y), x, y);
      store(noise.row<float>(y) + x, value, rounding, std::min(Lanes::size(), tile.x1 - x));
    }
  }
}

void ShadeRows(const ShadeUniforms& uniforms, bool corrected, Rounding rounding, const ShadeInputs& in, Image& colour,
               const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Surface<Lanes> s = load_surface(*in.hit, *in.normal, x, y);
      const Vec3<Lanes> c =
          corrected ? shade_corrected<Lanes>(uniforms, *in.environment, *in.ground, *in.relief, *in.bed, s, x, y)
                    : shade_as_published<Lanes>(uniforms, *in.environment, *in.ground, s, Lanes::load(in.noise->row<float>(y) + x), x, y);
      const Lanes rgba[4] = {c.x, c.y, c.z, Lanes(1.0f)};
      store4(colour.row<Half>(y) + 4 * x, rgba, rounding);
    }
  }
}

void DisplayRows(const DisplayUniforms& uniforms, bool corrected, Rounding rounding, const Image& colour, Image& picture,
                 const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      Lanes in[4];
      load4(colour.row<Half>(y) + 4 * x, in);
      const Vec3<Lanes> linear(in[0], in[1], in[2]);
      const Vec3<Lanes> c = corrected ? display_corrected<Lanes>(uniforms, linear, x, y) : display_as_published<Lanes>(uniforms, linear, x, y);
      const Lanes rgba[4] = {c.x, c.y, c.z, Lanes(1.0f)};
      store4(picture.row<Unorm8>(y) + 4 * x, rgba, rounding);
    }
  }
}
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
namespace rainref::puddle {

RAINREF_EXPORT(SurfaceHitRows);
RAINREF_EXPORT(GroundNoiseRows);
RAINREF_EXPORT(ShadeRows);
RAINREF_EXPORT(DisplayRows);

void surface_hit_rows(const SurfaceHitUniforms& uniforms, bool corrected, Rounding rounding, const Texture& wave, const Texture& bounds, Image& hit,
                    Image& normal, const parallel::Tile& tile) {
  RAINREF_DISPATCH(SurfaceHitRows)(uniforms, corrected, rounding, wave, bounds, hit, normal, tile);
}
void ground_noise_rows(const GroundNoiseUniforms& uniforms, Rounding rounding, const Image& hit, const Image& normal, Image& noise,
                       const parallel::Tile& tile) {
  RAINREF_DISPATCH(GroundNoiseRows)(uniforms, rounding, hit, normal, noise, tile);
}
void shade_rows(const ShadeUniforms& uniforms, bool corrected, Rounding rounding, const ShadeInputs& in, Image& colour,
                const parallel::Tile& tile) {
  RAINREF_DISPATCH(ShadeRows)(uniforms, corrected, rounding, in, colour, tile);
}
void display_rows(const DisplayUniforms& uniforms, bool corrected, Rounding rounding, const Image& colour, Image& picture,
                  const parallel::Tile& tile) {
  RAINREF_DISPATCH(DisplayRows)(uniforms, corrected, rounding, colour, picture, tile);
}

}  // namespace rainref::puddle
#endif
