// Normals of heightfields; compiled once for each SIMD target.
#include "compositor/sheet_normals.h"

#define RAINREF_KERNELS "compositor/kernels_sheet_normals.cpp"
#include "math/foreach_target.h"
#include "compositor/hit_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "compositor/heightfield_normal-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using N = DoubleLanes;
constexpr std::size_t n = static_cast<std::size_t>(N::size());
static_assert(most_lanes % n == 0);

void FacetNormals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals) {
  for (std::size_t i = 0; i < count; i += n) {
    const CellLanes at(hits + i, static_cast<int>(field.columns));
    put(facet_normal<N>(field, at.x, at.y, at.upper), i, normals);
  }
}

void InterpolatedNormals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals) {
  for (std::size_t i = 0; i < count; i += n) {
    const CellLanes at(hits + i, static_cast<int>(field.columns));
    put(interpolated_normal<N>(field, at.x, at.y, at.u, at.v), i, normals);
  }
}

void NormalsOfInterpolatedSlopes(const SlopeView& sheet, std::size_t count, const Hit* hits, const VecArraysOut& normals) {
  const N one(1.0);
  for (std::size_t i = 0; i < count; i += n) {
    const CellLanes at(hits + i, sheet.columns);
    const N::Int low = (at.y * (sheet.columns + 1) + at.x) * 2, high = low + 2 * (sheet.columns + 1);
    const auto slope = [&](int k) HWY_ATTR {
      const auto row = [&](N::Int vertex) HWY_ATTR {
        return (one - at.u) * fetch(sheet.slopes + k, vertex, N()) + at.u * fetch(sheet.slopes + k + 2, vertex, N());
      };
      return (one - at.v) * row(low) + at.v * row(high);
    };
    const N x = slope(0), z = slope(1), scale = one / sqrt(x * x + one + z * z);
    put(Vec3<N>(scale * x, scale, scale * z), i, normals);
  }
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(FacetNormals);
RAINREF_EXPORT(InterpolatedNormals);
RAINREF_EXPORT(NormalsOfInterpolatedSlopes);

void facet_normals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals) {
  RAINREF_DISPATCH(FacetNormals)(field, count, hits, normals);
}
void interpolated_normals(const HeightfieldView& field, std::size_t count, const Hit* hits, const VecArraysOut& normals) {
  RAINREF_DISPATCH(InterpolatedNormals)(field, count, hits, normals);
}
void normals_of_interpolated_slopes(const SlopeView& sheet, std::size_t count, const Hit* hits, const VecArraysOut& normals) {
  RAINREF_DISPATCH(NormalsOfInterpolatedSlopes)(sheet, count, hits, normals);
}

}  // namespace rainref::compositor
#endif
