// Shells of splat; compiled once for each SIMD target.
#include "drops/splat_kernels.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <vector>

#define RAINREF_KERNELS "drops/splat_kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(drops)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "drops/splat.pass.h"
#undef RAINREF_FN

// Where a texel may get something: a little more than the pass says, because its own arithmetic is rounded. What is
// offered in vain gets exactly 0. A span of centres c +- r covers the texels from past(c - r - more) to
// past(c + r + more - 1): half a texel leads from an index to its centre, an eighth is to spare.
constexpr float wider = 1.001f, more = 0.625f;

/// The first index above z, in [0, size].
HWY_INLINE int past(float z, int size) { return z < 0 ? 0 : z >= static_cast<float>(size) ? size : static_cast<int>(z) + 1; }

void MakeStamps(const SplatUniforms& u, Bands bands, const Drop* drops, std::int64_t begin, std::int64_t end, const StampedDrops& out) {
  const int n = Lanes::size();
  const int height = static_cast<int>(u.size[1]);
  const float shear = u.frame[1] / u.frame[2];
  const float columns = wider * __builtin_sqrtf(1.0f + shear * shear) / u.frame[0], rows = wider / u.frame[2];
  HWY_ALIGN float in[4][HWY_MAX_BYTES / sizeof(float)] = {}, made[5][HWY_MAX_BYTES / sizeof(float)];
  for (std::int64_t first = begin; first < end; first += n) {
    const int count = static_cast<int>(std::min<std::int64_t>(n, end - first));
    for (int k = 0; k < count; ++k) {
      const Drop& d = drops[first + k];
      in[0][k] = d.position[0];
      in[1][k] = d.position[1];
      in[2][k] = d.mass;
      in[3][k] = d.life;
    }
    const Stamp<Lanes> s = splat_stamp(u, Lanes::load(in[0]), Lanes::load(in[1]), Lanes::load(in[2]), Lanes::load(in[3]));
    const Lanes fields[5] = {s.x, s.y, s.radius, s.inverse_radius_sq, s.height};
    for (int f = 0; f < 5; ++f) hn::Store(fields[f].v, Lanes::D(), made[f]);
    for (int k = 0; k < count; ++k) {
      const float x = made[0][k], y = made[1][k], radius = made[2][k];
      const float half_width = radius * columns + more, half_height = radius * rows + more;
      const bool seen = made[4][k] > 0 && x + half_width > 0 && x - half_width < u.size[0];
      const int first_row = past(y - half_height, height), end_row = seen ? past(y + half_height - 1, height) : first_row;
      const std::size_t i = static_cast<std::size_t>(first + k);
      out.stamps[i] = {x, y, radius, made[3][k], made[4][k], half_width, first_row, end_row};
      const bool empty = end_row <= first_row;
      out.first_band[i] = static_cast<std::int8_t>(empty ? 1 : first_row / bands.rows);
      out.last_band[i] = static_cast<std::int8_t>(empty ? 0 : (end_row - 1) / bands.rows);
    }
  }
}

/// What a band draws on: halves of the texture itself, or floats that are stored when all drops are in.
template <SplatKernel kernel, class Target>
HWY_INLINE HWY_ATTR void draw(const SplatUniforms& u, Rounding rounding, const StampRecord& r, int row0, int row1, int width,
                              const Target& row_of) {
  const int n = Lanes::size();
  const SplatBlend blend = static_cast<SplatBlend>(u.blend);
  Stamp<Lanes> s;
  s.x = Lanes(r.x);
  s.y = Lanes(r.y);
  s.inverse_radius_sq = Lanes(r.inverse_radius_sq);
  s.height = Lanes(r.height);
  const auto blend_at = [&](auto* row, int x, float fy) RAINREF_LAMBDA {
    const Lanes drop = splat_contribution(u, kernel, s, Lanes::index(x) + Lanes(0.5f), Lanes(fy));
    // Rows of sums have room for a whole vector.
    const int count = std::is_same_v<decltype(row), float*> ? n : std::min(n, width - x);
    store(row + x, splat_blend(blend, Lanes::load(row + x), drop), rounding, count);
  };
  const int x0 = past(r.x - r.half_width, width), x1 = past(r.x + r.half_width - 1, width);
  if (x1 <= x0) return;
  if (x1 - x0 <= n) {
    for (int y = row0; y < row1; ++y) blend_at(row_of(y), x0, static_cast<float>(y) + 0.5f);
    return;
  }
  const float reach_sq = wider * wider * r.radius * r.radius, columns = 1.0f / u.frame[0];
  for (int y = row0; y < row1; ++y) {
    // The chord of the footprint in this row.
    const float fy = static_cast<float>(y) + 0.5f, dy = fy - r.y, plane_y = u.frame[2] * dy, chord_sq = reach_sq - plane_y * plane_y;
    if (chord_sq < 0) continue;
    const float half = __builtin_sqrtf(chord_sq) * columns + more, centre = r.x - u.frame[1] * dy * columns;
    const int end = past(centre + half - 1, width);
    for (int x = past(centre - half, width); x < end; x += n) blend_at(row_of(y), x, fy);
  }
}

// Calls drawn(stamp) for every stamp that reaches the band, in slot order.
template <class Drawn>
HWY_INLINE HWY_ATTR void for_stamps_of(const StampedDrops& drops, int band, const Drawn& drawn) {
  const hn::ScalableTag<std::int8_t> d;
  const std::size_t count = drops.stamps.size(), n = hn::Lanes(d);
  const auto wanted = hn::Set(d, static_cast<std::int8_t>(band));
  std::size_t i = 0;
  for (; i + n <= count; i += n) {
    const auto first = hn::LoadU(d, drops.first_band.data() + i), last = hn::LoadU(d, drops.last_band.data() + i);
    const auto reached = hn::Not(hn::Or(hn::Gt(first, wanted), hn::Lt(last, wanted)));
    std::uint8_t bytes[HWY_MAX_BYTES / 8 < 8 ? 8 : HWY_MAX_BYTES / 8] = {};
    hn::StoreMaskBits(d, reached, bytes);
    for (std::size_t word = 0; word < n; word += 64) {
      std::uint64_t bits;
      std::memcpy(&bits, bytes + word / 8, sizeof bits);
      for (; bits != 0; bits &= bits - 1) drawn(drops.stamps[i + word + static_cast<std::size_t>(std::countr_zero(bits))]);
    }
  }
  for (; i < count; ++i) {
    if (drops.first_band[i] <= band && band <= drops.last_band[i]) drawn(drops.stamps[i]);
  }
}

// A row of the film, its end texels once more on both sides.
HWY_INLINE void copy_film_row(const Image& film, int y, float* to) {
  const int width = film.width();
  const float* from = film.row<float>(std::clamp(y, 0, film.height() - 1));
  std::copy_n(from, width, to + 1);
  to[0] = from[0];
  to[width + 1] = from[width - 1];
}

template <SplatKernel kernel>
void band_of(const SplatJob& job, Bands bands, int band, const StampedDrops& drops) {
  const SplatUniforms u = job.uniforms;
  Image& image = *job.height;
  const int n = Lanes::size(), width = image.width(), y0 = band * bands.rows, y1 = std::min(image.height(), y0 + bands.rows);
  const auto rows_of = [&](const StampRecord& r, auto&& row_of) RAINREF_LAMBDA {
    draw<kernel>(u, job.rounding, r, std::max(y0, r.first_row), std::min(y1, r.end_row), width, row_of);
  };
  if (job.half_accumulation) {
    for (int y = y0; y < y1; ++y) std::memset(image.row<Half>(y), 0, static_cast<std::size_t>(width) * sizeof(Half));
    for_stamps_of(drops, band, [&](const StampRecord& r) RAINREF_LAMBDA { rows_of(r, [&](int y) RAINREF_LAMBDA { return image.row<Half>(y); }); });
    return;
  }
  const std::size_t pitch = static_cast<std::size_t>(width + n);
  std::vector<float> sums(pitch * static_cast<std::size_t>(y1 - y0));
  const auto sum_row = [&](int y) RAINREF_LAMBDA { return sums.data() + pitch * static_cast<std::size_t>(y - y0); };
  for_stamps_of(drops, band, [&](const StampRecord& r) RAINREF_LAMBDA { rows_of(r, sum_row); });
  const std::size_t film_pitch = pitch + 2;
  std::vector<float> film(job.film ? 3 * film_pitch : 0);
  float* rows[3] = {film.data(), film.data() + film_pitch, film.data() + 2 * film_pitch};
  if (job.film) {
    copy_film_row(*job.film, y0 - 1, rows[1]);
    copy_film_row(*job.film, y0, rows[2]);
  }
  for (int y = y0; y < y1; ++y) {
    if (job.film) {
      std::rotate(rows, rows + 1, rows + 3);
      copy_film_row(*job.film, y + 1, rows[2]);
    }
    for (int x = 0; x < width; x += n) {
      Lanes height = Lanes::load(sum_row(y) + x);
      if (job.film) height = film_height<Lanes>(u, rows[0] + 1, rows[1] + 1, rows[2] + 1, x) + height;
      store(image.row<Half>(y) + x, height, job.rounding, std::min(n, width - x));
    }
  }
}
void SplatBand(const SplatJob& job, Bands bands, int band, const StampedDrops& drops) {
  switch (static_cast<SplatKernel>(job.uniforms.kernel)) {
    case SplatKernel::paraboloid: return band_of<SplatKernel::paraboloid>(job, bands, band, drops);
    case SplatKernel::quartic: return band_of<SplatKernel::quartic>(job, bands, band, drops);
    case SplatKernel::smoothstep: return band_of<SplatKernel::smoothstep>(job, bands, band, drops);
    case SplatKernel::hemisphere: return band_of<SplatKernel::hemisphere>(job, bands, band, drops);
    case SplatKernel::disc: return band_of<SplatKernel::disc>(job, bands, band, drops);
  }
}
#undef RAINREF_LAMBDA
RAINREF_TARGET_END(drops)

#if RAINREF_ONCE
namespace rainref::drops {

RAINREF_EXPORT(MakeStamps);
RAINREF_EXPORT(SplatBand);

Bands splat_bands(int height) {
  // Few, because each looks at every stamp; but more than a processor has cores.
  constexpr int most = 32, fewest_rows = 16;
  const int rows = std::max(fewest_rows, (height + most - 1) / most);
  return {rows, (height + rows - 1) / rows};
}
void make_stamps(const SplatUniforms& uniforms, Bands bands, std::span<const Drop> drops, std::int64_t begin, std::int64_t end,
                 const StampedDrops& out) {
  RAINREF_DISPATCH(MakeStamps)(uniforms, bands, drops.data(), begin, end, out);
}
void splat_band(const SplatJob& job, Bands bands, int band, const StampedDrops& drops) {
  RAINREF_DISPATCH(SplatBand)(job, bands, band, drops);
}

}  // namespace rainref::drops
#endif
