// Finishes of many places on the ground at once; compiled once for each SIMD target.
#include "puddle/checkerboard.h"
#include "truth/puddle_ground.h"

#define RAINREF_KERNELS "truth/kernels_ground.cpp"
#include "math/foreach_target.h"
#include "math/double_lanes-inl.h"

RAINREF_TARGET_BEGIN(truth)

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "puddle/ground_level-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using N = DoubleLanes;
constexpr std::size_t n = static_cast<std::size_t>(N::size());

void FinishGround(const GroundLook& look, const Places& places, const VecArrays* slopes, const Finishes& finishes) {
  const puddle::ShadeUniforms& u = look.uniforms;
  const N zero(0.0), one(1.0);
  const float dry_film = 1 - u.wetness;
  // Levels first, because they end a long chain of dependent operations, and separately several chains run at once.
  for (std::size_t i = 0; i < places.size(); i += n) {
    const N down = N::load(places.direction.component[1] + i);
    hn::StoreU(ground_level(N(u.ground_footprint * look.sample_scale), N::load(places.distance + i), -down).v, N::D(), finishes.blur + i);
  }
  for (std::size_t i = 0; i < places.size(); i += n) {
    const auto of = [i](const VecArrays& values, int k) HWY_ATTR { return N::load(values.component[k] + i); };
    const N px = of(places.point, 0), py = of(places.point, 1), pz = of(places.point, 2);
    const N dx = of(places.direction, 0), dy = of(places.direction, 1), dz = of(places.direction, 2);
    const N lod = N::load(finishes.blur + i);
    const N s = px * N(u.ground_scale), t = pz * N(u.ground_scale);
    N albedo[3];
    if (u.use_checkerboard != 0) {
      const N sum = floor(s) + floor(t);
      const auto even = sum - N(2.0) * floor(sum * N(0.5)) <= zero;
      for (int k = 0; k < 3; ++k) albedo[k] = select(even, N(puddle::checkerboard_dark[k]), N(puddle::checkerboard_light[k]));
    } else {
      const auto texel = sample_mip<0, 3, N>(fixed_texture<Address::repeat, Address::repeat, 4>(*look.ground), s, t, lod);
      for (int k = 0; k < 3; ++k) albedo[k] = texel[k];
    }
    const auto wet = py < zero;
    // Light comes down through the column of water; the medium handles the way back.
    N sunk[3] = {zero, zero, zero};
    if (any(wet)) {
      const N left = transmittance(N(u.water_turbidity), select(wet, -py, zero));
      for (int k = 0; k < 3; ++k) sunk[k] = N(u.ambient[k]) * (left * albedo[k] + (one - left) * N(u.tint[k]));
    }
    N reflectance = zero, level = zero, mx = zero, my = zero, mz = zero;
    if (any(!wet)) {
      // Slopes of grains finer than a pixel blur its reflection, so they are sampled instead of averaged.
      const auto tilt = sample_bilinear<0, 2, N>(fixed_texture<Address::repeat, Address::repeat, 2>(*look.relief), s, t);
      const N film = smoothstep(0.0f, u.shore_width, N(u.shore_width) - py), rough = one - film;
      N slope_x = zero, slope_z = zero;
      if (slopes != nullptr) {
        const N up = of(*slopes, 1);
        slope_x = of(*slopes, 0) / up;
        slope_z = of(*slopes, 2) / up;
      }
      const N x = slope_x + rough * tilt[0], z = slope_z + rough * tilt[1];
      const N scale = one / sqrt(x * x + one + z * z);
      const N nx = x * scale, ny = scale, nz = z * scale;
      const N cosine = min(max(-(dx * nx + dy * ny + dz * nz), N(1e-3)), one);
      reflectance = select(wet, zero, fresnel_dielectric(cosine, look.water_ior) * (N(u.wetness) + N(dry_film) * film));
      level = select(wet, zero, N(2.0) * rough);
      mx = select(wet, zero, nx);
      my = select(wet, zero, ny);
      mz = select(wet, zero, nz);
    }
    const auto put = [i](N x, double* to) HWY_ATTR { hn::StoreU(x.v, N::D(), to + i); };
    const N normal[3] = {mx, my, mz};
    for (int k = 0; k < 3; ++k) {
      put(select(wet, sunk[k], (one - reflectance) * N(u.ambient[k]) * albedo[k]), finishes.radiance.component[k]);
      put(reflectance, finishes.mirror.component[k]);
      put(normal[k], finishes.mirror_normal.component[k]);
    }
    put(level, finishes.blur);
  }
}

RAINREF_TARGET_END(truth)

#if RAINREF_ONCE
namespace rainref::truth {

RAINREF_EXPORT(FinishGround);

void finish_ground(const GroundLook& look, const Places& places, const VecArrays* slopes, const Finishes& finishes) {
  RAINREF_DISPATCH(FinishGround)(look, places, slopes, finishes);
}

}  // namespace rainref::truth
#endif
