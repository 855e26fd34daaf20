// Shell of the views between keyframes; compiled once for each SIMD target.
#include <type_traits>

#include "windshield/scene/street.h"

#define RAINREF_KERNELS "windshield/scene/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "windshield/scene/reproject.pass.h"

void ReprojectRows(const ReprojectUniforms& uniforms, const Keyframe& behind, const Keyframe& ahead, SceneView& view,
                   const parallel::Tile& tile) {
  constexpr Address edge = Address::clamp;
  const StoredTexture<Half> colours[2] = {stored_texture<Half>(behind.colour), stored_texture<Half>(ahead.colour)};
  const StoredTexture<float> depths[2] = {stored_texture<float>(behind.depth), stored_texture<float>(ahead.depth)};
  const auto behind_colour = fixed_texture<edge, edge, 4>(colours[0]), ahead_colour = fixed_texture<edge, edge, 4>(colours[1]);
  const auto behind_depth = fixed_texture<edge, edge, 1>(depths[0]), ahead_depth = fixed_texture<edge, edge, 1>(depths[1]);
  constexpr int size = Lanes::size();
  const auto columns = [&]<int Count>(std::integral_constant<int, Count>, int x, int y) HWY_ATTR {
    reprojected<Lanes, Count>(uniforms, behind_colour, behind_depth, ahead_colour, ahead_depth, x, y,
                              [&](int k, const Between<Lanes>& s) RAINREF_LAMBDA {
                                const int column = x + k * size;
                                const Lanes rgba[4] = {s.colour.x, s.colour.y, s.colour.z, Lanes(1.0f)};
                                store4(view.colour.row<Half>(y) + 4 * column, rgba, Rounding::rne);
                                store(view.depth.row<float>(y) + column, s.depth, Rounding::rne, size);
                              });
  };
  constexpr int many = 8;
  for (int y = tile.y0; y < tile.y1; ++y) {
    int x = tile.x0;
    for (; x + many * size <= tile.x1; x += many * size) columns(std::integral_constant<int, many>(), x, y);
    for (; x < tile.x1; x += size) columns(std::integral_constant<int, 1>(), x, y);
  }
}
#undef RAINREF_FN
#undef RAINREF_LAMBDA
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
namespace rainref::windshield {

RAINREF_EXPORT(ReprojectRows);

void reproject_rows(const ReprojectUniforms& uniforms, const Keyframe& behind, const Keyframe& ahead, SceneView& view,
                    const parallel::Tile& tile) {
  RAINREF_DISPATCH(ReprojectRows)(uniforms, behind, ahead, view, tile);
}

}  // namespace rainref::windshield
#endif
