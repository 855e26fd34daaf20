// surface_hit, ground_noise, shade and display in lanes; compiled once for each SIMD target.
#include <concepts>
#include <cstdint>

#include "pass/run.h"
#include "puddle/display.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/surface_hit.pass.h"

#define RAINREF_KERNELS "puddle/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/lane_pair-inl.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "image/environment-inl.h"
// Two vectors are sampled one after the other.
template <int First, int Count, std::same_as<LanePair> N, class T>
RAINREF_FN Channels<N, Count> sample_bilinear(const T& t, N u, N v, int level = 0) {
  const auto a = sample_bilinear<First, Count, Lanes>(t, u.a, v.a, level), b = sample_bilinear<First, Count, Lanes>(t, u.b, v.b, level);
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; ++k) out[k] = N(a[k], b[k]);
  return out;
}
#include "puddle/surface_hit.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/display.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using HitIo = SurfaceHitPass::Io<LaneCursors>;
HWY_INLINE HWY_ATTR void give_hit(HitIo& io, int x, int count, const Vec3<Lanes>& position, Lanes iterations, const Vec3<Lanes>& normal,
                                  Lanes flag) {
  pass::move_to<SurfaceHitPass>(io, x, count);
  io.hit(position, iterations);
  io.normal(normal, flag);
}
// As published a round of the march waits for the one before: for quotients, a lookup, a root. Two rays of a row side by side, in each
// lane, keep the processor busy meanwhile.
template <Address edge>
HWY_ATTR void published_hit_rows(const SurfaceHitUniforms& uniforms, Rounding rounding, const pass::HostIo<SurfaceHitPass>& host,
                                 const parallel::Tile& tile) {
  const SurfaceHitUniforms u = uniforms;
  const Texture& texture = *host.wave.texture;
  const auto wave = fixed_texture<edge, edge, 1>(texture);
  for (int y = tile.y0; y < tile.y1; ++y) {
    HitIo io;
    pass::begin_row<SurfaceHitPass>(host, io, y, rounding);
    constexpr int n = Lanes::size();
    int x = tile.x0;
    for (; x + 2 * n <= tile.x1; x += 2 * n) {
      const SurfaceHit<LanePair> s = surface_hit_as_published<LanePair>(u, wave, x, y);
      const Vec3<LanePair>&p = s.position, &m = s.normal;
      give_hit(io, x, n, Vec3<Lanes>(p.x.a, p.y.a, p.z.a), s.iterations.a, Vec3<Lanes>(m.x.a, m.y.a, m.z.a), s.flag.a);
      give_hit(io, x + n, n, Vec3<Lanes>(p.x.b, p.y.b, p.z.b), s.iterations.b, Vec3<Lanes>(m.x.b, m.y.b, m.z.b), s.flag.b);
    }
    for (; x < tile.x1; x += n) {
      const SurfaceHit<Lanes> s = surface_hit_as_published<Lanes>(u, wave, x, y);
      give_hit(io, x, tile.x1 - x < n ? tile.x1 - x : n, s.position, s.iterations, s.normal, s.flag);
    }
  }
}
HWY_ATTR void SurfaceHitPassRows(const SurfaceHitUniforms& u, bool corrected, Rounding rounding, const pass::HostIo<SurfaceHitPass>& io,
                                 const parallel::Tile& tile) {
  const Texture& wave = *io.wave.texture;
  if (corrected) return rows_of<SurfaceHitPass, SurfaceHitPassText, true>(u, rounding, io, tile);
  if (wave.address_u == Address::clamp && wave.address_v == Address::clamp)
    return published_hit_rows<Address::clamp>(u, rounding, io, tile);
  if (wave.address_u == Address::repeat && wave.address_v == Address::repeat)
    return published_hit_rows<Address::repeat>(u, rounding, io, tile);
  rows_of<SurfaceHitPass, SurfaceHitPassText, false>(u, rounding, io, tile);
}
RAINREF_PASS_ROWS(GroundNoisePass)
RAINREF_PASS_ROWS(ShadePass)
RAINREF_PASS_ROWS(DisplayPass)
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(puddle, SurfaceHitPass)
RAINREF_PASS_DISPATCH(puddle, GroundNoisePass)
RAINREF_PASS_DISPATCH(puddle, ShadePass)
RAINREF_PASS_DISPATCH(puddle, DisplayPass)
#endif
