// surface_hit, ground_noise, shade and display in lanes; compiled once for each SIMD target.
#include <concepts>
#include <cstdint>
#include <cstring>

#include "pass/run.h"
#include "puddle/display.pass.h"
#include "puddle/kernels.h"
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
template <int First, int Count, std::same_as<LanePair> N, class T>
RAINREF_FN Channels<N, Count> sample_nearest(const T& t, N u, N v) {
  const auto a = sample_nearest<First, Count, Lanes>(t, u.a, v.a), b = sample_nearest<First, Count, Lanes>(t, u.b, v.b);
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; ++k) out[k] = N(a[k], b[k]);
  return out;
}
template <int Channel, std::same_as<LanePair> N, class T>
RAINREF_FN Neighbours<N> sample_neighbours(const T& t, N u, N v) {
  const auto a = sample_neighbours<Channel, Lanes>(t, u.a, v.a), b = sample_neighbours<Channel, Lanes>(t, u.b, v.b);
  return {N(a.left, b.left), N(a.right, b.right), N(a.down, b.down), N(a.up, b.up)};
}
// Called, not inlined, like the loops below: shade has two lookups, and engines of WebAssembly keep the vectors of a huge function in
// memory.
inline HWY_NOINLINE HWY_ATTR Vec3<Lanes> sample_environment(const Texture& t, bool is_cube, const Vec3<Lanes>& d, Lanes lod) {
  return sample_environment<Lanes>(t, is_cube, d, lod);
}
#include "puddle/surface_hit.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/display.pass.h"
template <bool corrected, class N, class T>
RAINREF_FN SurfaceHit<N> hit_of(const SurfaceHitUniforms& u, const pass::HostIo<SurfaceHitPass>& host, const T& wave, int x, int y) {
  if constexpr (corrected)
    return surface_hit_corrected<N>(u, *host.wave.texture, *host.bounds.texture, x, y);
  else
    return surface_hit_as_published<N>(u, wave, x, y);
}
#undef RAINREF_FN
#undef RAINREF_LAMBDA

using HitIo = SurfaceHitPass::Io<LaneCursors>;
HWY_INLINE HWY_ATTR void give_hit(HitIo& io, int x, int count, const Vec3<Lanes>& position, Lanes iterations, const Vec3<Lanes>& normal,
                                  Lanes flag) {
  pass::move_to<SurfaceHitPass>(io, x, count);
  io.hit(position, iterations);
  io.normal(normal, flag);
}
// A round of the march waits for the one before: for quotients, a lookup, a root. Two rays of a row side by side in each lane keep the
// processor busy.
template <bool corrected, Address edge>
HWY_NOINLINE HWY_ATTR void paired_hit_rows(const SurfaceHitUniforms& uniforms, Rounding rounding, const pass::HostIo<SurfaceHitPass>& host,
                                           const parallel::Tile& tile) {
  const SurfaceHitUniforms u = uniforms;
  const auto wave = fixed_texture<edge, edge, 1>(*host.wave.texture);
  for (int y = tile.y0; y < tile.y1; ++y) {
    HitIo io;
    pass::begin_row<SurfaceHitPass>(host, io, y, rounding);
    constexpr int n = Lanes::size();
    int x = tile.x0;
    for (; x + 2 * n <= tile.x1; x += 2 * n) {
      const SurfaceHit<LanePair> s = hit_of<corrected, LanePair>(u, host, wave, x, y);
      const Vec3<LanePair>&p = s.position, &m = s.normal;
      give_hit(io, x, n, Vec3<Lanes>(p.x.a, p.y.a, p.z.a), s.iterations.a, Vec3<Lanes>(m.x.a, m.y.a, m.z.a), s.flag.a);
      give_hit(io, x + n, n, Vec3<Lanes>(p.x.b, p.y.b, p.z.b), s.iterations.b, Vec3<Lanes>(m.x.b, m.y.b, m.z.b), s.flag.b);
    }
    for (; x < tile.x1; x += n) {
      const SurfaceHit<Lanes> s = hit_of<corrected, Lanes>(u, host, wave, x, y);
      give_hit(io, x, tile.x1 - x < n ? tile.x1 - x : n, s.position, s.iterations, s.normal, s.flag);
    }
  }
}
HWY_ATTR void SurfaceHitPassRows(const SurfaceHitUniforms& u, bool corrected, Rounding rounding, const pass::HostIo<SurfaceHitPass>& io,
                                 const parallel::Tile& tile) {
  const Texture& wave = *io.wave.texture;
#if RAINREF_HALF_TEXELS
  if (corrected) return paired_hit_rows<true, Address::clamp>(u, rounding, io, tile);
#else
  if (corrected) return rows_of<SurfaceHitPass, SurfaceHitPassText, true>(u, rounding, io, tile);
#endif
  if (wave.address_u == Address::clamp && wave.address_v == Address::clamp)
    return paired_hit_rows<false, Address::clamp>(u, rounding, io, tile);
  if (wave.address_u == Address::repeat && wave.address_v == Address::repeat)
    return paired_hit_rows<false, Address::repeat>(u, rounding, io, tile);
  rows_of<SurfaceHitPass, SurfaceHitPassText, false>(u, rounding, io, tile);
}
RAINREF_PASS_ROWS(GroundNoisePass)
RAINREF_PASS_ROWS(ShadePass)
RAINREF_PASS_ROWS(DisplayPass)

// If no lane sees the puddle's ground or water, the picture behind is the whole result of shade: the ground would have the weight 0, and is
// finite, which the caller ensures. That picture never changes; `kept` holds its known parts, with alpha 1.
HWY_NOINLINE HWY_ATTR void ShadeOrBackground(const ShadeUniforms& uniforms, Rounding rounding, const pass::HostIo<ShadePass>& host,
                                             Image& colour, Image& kept, const parallel::Tile& tile) {
  const ShadeUniforms u = uniforms;
  const Lanes one(1.0f), half(0.5f);
  for (int y = tile.y0; y < tile.y1; ++y) {
    ShadePass::Io<LaneCursors> io;
    pass::begin_row<ShadePass>(host, io, y, rounding);
    Half *const out = colour.row<Half>(y), *const known = kept.row<Half>(y);
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      pass::move_to<ShadePass>(io, x, tile.x1 - x < Lanes::size() ? tile.x1 - x : Lanes::size());
      const Surface<Lanes> s = surface_of<Lanes>(io);
      const Lanes own = share_beyond(u, s.position.x * Lanes(u.inverse_size[0]), s.position.z * Lanes(u.inverse_size[1]));
      if (any((s.flag > half) & !((own >= one) & (own <= one)))) {
        ShadePassText::run<Lanes, true>(u, io, x, y);
      } else if (known[4 * x + 3].bits != 0) {
        std::memcpy(out + 4 * x, known + 4 * x, sizeof(Half) * 4 * Lanes::size());
      } else {
        const Vec3<Lanes> view = camera_ray(u.camera, Lanes::index(x), Lanes(static_cast<float>(y)));
        io.colour(background(u, io.environment, view), one);
        std::memcpy(known + 4 * x, out + 4 * x, sizeof(Half) * 4 * Lanes::size());
      }
    }
  }
}
void DisplayCodes(Rounding rounding, const float* x, std::uint8_t* code, int count) {
  HWY_ALIGN float numbers[HWY_MAX_BYTES / sizeof(float)] = {};
  HWY_ALIGN std::uint8_t codes[HWY_MAX_BYTES];
  constexpr int n = Lanes::size();
  for (int k = 0; k < count; k += n) {
    const int now = count - k < n ? count - k : n;
    for (int i = 0; i < now; ++i) numbers[i] = x[k + i];
    const Lanes c = Lanes::load(numbers);
    hn::StoreU(display_code(Vec3<Lanes>(c, c, c)).x.unorm8_codes(rounding), Lanes::DB(), codes);
    for (int i = 0; i < now; ++i) code[k + i] = codes[i];
  }
}
/// The bits of a code in each lane.
HWY_INLINE HWY_ATTR hn::Vec<Lanes::DI> code_of(const CodeSteps::Bucket* buckets, Lanes x) {
  const Lanes::DI d;
  // Without NaN, for which the function gives 0.
  const Lanes zero(0.0f), held = min(select(x > zero, x, zero), Lanes(1.0f));
  const auto bucket = hn::Max(hn::Sub(hn::ShiftRight<CodeSteps::shift>(hn::BitCast(d, held.v)), hn::Set(d, CodeSteps::first)), hn::Zero(d));
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  const WordPair w = gather_words(buckets, hn::ShiftLeft<3>(bucket));
  const auto code = w.second;
  const Lanes step(hn::BitCast(Lanes::D(), w.first));
#else
  const auto word = hn::ShiftLeft<1>(bucket);
  const Lanes step(hn::GatherIndex(Lanes::D(), &buckets->step, word));
  const auto code = hn::GatherIndex(d, &buckets->code, word);
#endif
  // True is -1.
  return hn::Sub(code, hn::BitCast(d, hn::VecFromMask(Lanes::D(), (held >= step).m)));
}
HWY_NOINLINE HWY_ATTR void DisplayBySteps(const DisplayUniforms& uniforms, const CodeSteps& steps, const Image& colour, Image& picture,
                                          const parallel::Tile& tile) {
  const DisplayUniforms u = uniforms;
  const CodeSteps::Bucket* const buckets = steps.data();
  const Lanes::DI d;
  const auto opaque = hn::Set(d, static_cast<std::int32_t>(0xff000000u));
  for (int y = tile.y0; y < tile.y1; ++y) {
    const Half* in = colour.row<Half>(y);
    std::int32_t* out = reinterpret_cast<std::int32_t*>(picture.row<Unorm8>(y));  // the first code is the lowest byte
    for (int x = tile.x0; x < tile.x1; x += Lanes::size()) {
      Lanes c[4];
      load4(in + 4 * x, c);
      const Vec3<Lanes> light = exposed(u, Vec3<Lanes>(c[0], c[1], c[2]), x, y);
      const auto red = code_of(buckets, light.x), green = code_of(buckets, light.y), blue = code_of(buckets, light.z);
      hn::StoreU(hn::Or(hn::Or(red, hn::ShiftLeft<8>(green)), hn::Or(hn::ShiftLeft<16>(blue), opaque)), d, out + x);
    }
  }
}
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(puddle, SurfaceHitPass)
RAINREF_PASS_DISPATCH(puddle, GroundNoisePass)
RAINREF_PASS_DISPATCH(puddle, ShadePass)
RAINREF_PASS_DISPATCH(puddle, DisplayPass)
namespace rainref::puddle {

RAINREF_EXPORT(ShadeOrBackground);
RAINREF_EXPORT(DisplayCodes);
RAINREF_EXPORT(DisplayBySteps);

void shade_or_background(const ShadeUniforms& u, Rounding rounding, const pass::HostIo<ShadePass>& io, Image& colour, Image& kept,
                         const parallel::Tile& tile) {
  RAINREF_DISPATCH(ShadeOrBackground)(u, rounding, io, colour, kept, tile);
}
void display_codes(Rounding rounding, const float* x, std::uint8_t* code, int count) {
  RAINREF_DISPATCH(DisplayCodes)(rounding, x, code, count);
}
CodeSteps display_steps(Rounding rounding) {
  return CodeSteps([rounding](const float* x, std::uint8_t* code, int count) { display_codes(rounding, x, code, count); });
}
void display_by_steps(const DisplayUniforms& u, const CodeSteps& steps, const Image& colour, Image& picture, const parallel::Tile& tile) {
  RAINREF_DISPATCH(DisplayBySteps)(u, steps, colour, picture, tile);
}

}  // namespace rainref::puddle
#endif
