// Lookups of many rays at once; compiled once for each SIMD target.
#include <algorithm>

#include "compositor/shading_kernels.h"

#define RAINREF_KERNELS "compositor/kernels_shading.cpp"
#include "math/foreach_target.h"
#include "math/double_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "image/sampling-inl.h"
#include "image/environment-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using N = DoubleLanes;
constexpr std::size_t n = static_cast<std::size_t>(N::size());

HWY_INLINE HWY_ATTR void keep(N x, double* p) { hn::Store(x.v, N::D(), p); }

void LookUp(const Texture& texture, bool is_cube, const Rotation& rotation, const EscapedRays& escaped_rays, std::span<Vec> radiance) {
  for (std::size_t i = 0; i < escaped_rays.size(); i += n) {
    const N x = N::load(escaped_rays.direction.component[0] + i), y = N::load(escaped_rays.direction.component[1] + i),
            z = N::load(escaped_rays.direction.component[2] + i), blur = N::load(escaped_rays.blur + i);
    const Vec3<N> turned(N(rotation.cosine) * x + N(rotation.sine) * z, y, N(rotation.cosine) * z - N(rotation.sine) * x);
    const Vec3<N> seen = sample_environment(texture, is_cube, turned, blur);
    HWY_ALIGN double out[3][n];
    keep(seen.x, out[0]);
    keep(seen.y, out[1]);
    keep(seen.z, out[2]);
    for (std::size_t k = 0; k < std::min(n, escaped_rays.size() - i); ++k) radiance[i + k] = {out[0][k], out[1][k], out[2][k]};
  }
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(LookUp);

void look_up(const Texture& texture, bool is_cube, const Rotation& rotation, const EscapedRays& escaped_rays, std::span<Vec> radiance) {
  RAINREF_DISPATCH(LookUp)(texture, is_cube, rotation, escaped_rays, radiance);
}

}  // namespace rainref::compositor
#endif
