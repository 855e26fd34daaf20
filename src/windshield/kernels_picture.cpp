// Shell of composite; compiled once for each SIMD target.
#include <algorithm>

#include "windshield/picture.h"

#define RAINREF_KERNELS "windshield/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "windshield/composite.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

void CompositeRows(const CompositeUniforms& uniforms, bool corrected, Rounding rounding, const CompositeInputs& in, Image& colour, const parallel::Tile& tile) {
  constexpr Address edge = Address::clamp;
  const auto pyramid = fixed_texture<edge, edge, 4>(in.pyramid), normal = fixed_texture<edge, edge, 4>(in.normal);
  const auto height = fixed_texture<edge, edge, 1>(in.height), mask = fixed_texture<edge, edge, 1>(in.mask);
  const auto depth = fixed_texture<edge, edge, 1>(in.depth);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Vec3<Lanes> c = corrected ? composite_corrected<Lanes>(uniforms, pyramid, depth, height, normal, mask, in.glints.data(), x, y)
                                      : composite_as_published<Lanes>(uniforms, pyramid, height, normal, mask, in.glints.data(), x, y);
      const Lanes rgba[4] = {c.x, c.y, c.z, Lanes(1.0f)};
      store4(colour.row<Half>(y) + 4 * x, rgba, rounding);
    }
  }
}
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
namespace rainref::windshield {

RAINREF_EXPORT(CompositeRows);

void composite_rows(const CompositeUniforms& uniforms, bool corrected, Rounding rounding, const CompositeInputs& in, Image& colour, const parallel::Tile& tile) {
  RAINREF_DISPATCH(CompositeRows)(uniforms, corrected, rounding, in, colour, tile);
}

}  // namespace rainref::windshield
#endif
