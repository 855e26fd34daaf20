// The shell of display; compiled once for each SIMD target.
#include "scene/display.h"

#include "math/real64.h"

#define RAINREF_KERNELS "scene/display.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(scene)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "scene/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

void DisplayRows(const DisplayUniforms& uniforms, Rounding rounding, const Image& colour, Image& picture, const parallel::Tile& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      Lanes in[4];
      load4(colour.row<Half>(y) + 4 * x, in);
      const Vec3<Lanes> c = display<Lanes>(uniforms, Vec3<Lanes>(in[0], in[1], in[2]));
      const Lanes rgba[4] = {c.x, c.y, c.z, Lanes(1.0f)};
      store4(picture.row<Unorm8>(y) + 4 * x, rgba, rounding);
    }
  }
}
RAINREF_TARGET_END(scene)

#if RAINREF_ONCE
namespace rainref::scene {

RAINREF_EXPORT(DisplayRows);

void display_rows(const DisplayUniforms& uniforms, Rounding rounding, const Image& colour, Image& picture, const parallel::Tile& tile) {
  RAINREF_DISPATCH(DisplayRows)(uniforms, rounding, colour, picture, tile);
}
DisplayUniforms display_uniforms(double exposure) {
  DisplayUniforms u{};
  u.exposure = static_cast<float>(exp2_real(Real64(exposure)).v);
  return u;
}
CodeTable display_table(int width, int height, double exposure, Rounding rounding) {
  return CodeTable(width, height, [u = display_uniforms(exposure), rounding](const Image& colour, Image& picture, int y0, int y1) { display_rows(u, rounding, colour, picture, {0, y0, colour.width(), y1}); });
}

}  // namespace rainref::scene
#endif
