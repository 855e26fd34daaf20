// Shell of the views between keyframes; compiled once for each SIMD target.
#include <algorithm>

#include "windshield/street.h"

#define RAINREF_KERNELS "windshield/kernels_street.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "windshield/reproject.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

void ReprojectRows(const ReprojectUniforms& uniforms, const Keyframe& behind, const Keyframe& ahead, SceneView& view, const parallel::Tile& tile) {
  constexpr Address edge = Address::clamp;
  const StoredTexture<Half> colours[2] = {stored_texture<Half>(behind.colour), stored_texture<Half>(ahead.colour)};
  const StoredTexture<float> depths[2] = {stored_texture<float>(behind.depth), stored_texture<float>(ahead.depth)};
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      const Between<Lanes> s =
          reprojected<Lanes>(uniforms, fixed_texture<edge, edge, 4>(colours[0]), fixed_texture<edge, edge, 1>(depths[0]), fixed_texture<edge, edge, 4>(colours[1]), fixed_texture<edge, edge, 1>(depths[1]), x, y);
      const Lanes rgba[4] = {s.colour.x, s.colour.y, s.colour.z, Lanes(1.0f)};
      store4(view.colour.row<Half>(y) + 4 * x, rgba, Rounding::rne);
      store(view.depth.row<float>(y) + x, s.depth, Rounding::rne, std::min(Lanes::size(), tile.x1 - x));
    }
  }
}
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
namespace rainref::windshield {

RAINREF_EXPORT(ReprojectRows);

void reproject_rows(const ReprojectUniforms& uniforms, const Keyframe& behind, const Keyframe& ahead, SceneView& view, const parallel::Tile& tile) {
  RAINREF_DISPATCH(ReprojectRows)(uniforms, behind, ahead, view, tile);
}

}  // namespace rainref::windshield
#endif
