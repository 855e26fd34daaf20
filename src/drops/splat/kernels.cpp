// Shells of splat; compiled once for each SIMD target.
#include "drops/splat/kernels.h"

#include "drops/splat/splat.pass.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <vector>

#define RAINREF_KERNELS "drops/splat/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lane_pair-inl.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(drops)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/cube_root_lanes-inl.h"
#include "drops/drop-inl.h"
#include "drops/neck-inl.h"
#include "drops/splat/splat.pass.h"
#undef RAINREF_FN

// Texels that may receive water: slightly more than the pass says, because this arithmetic is rounded. A surplus texel gets exactly 0. A
// span of centres c +- r covers the texels from past(c - r - more) to past(c + r + more - 1): half a texel is the distance from an index to
// its centre, an eighth is a margin.
constexpr float wider = 1.001f, more = 0.625f;

/// The first index above z, in [0, size].
HWY_INLINE int past(float z, int size) { return z < 0 ? 0 : z >= static_cast<float>(size) ? size : static_cast<int>(z) + 1; }

/// Index of its neck, which are in ascending id, or -1.
std::int32_t place_of(std::span<const Neck> necks, std::uint32_t id) {
  const auto at = std::lower_bound(necks.begin(), necks.end(), id, [](const Neck& n, std::uint32_t sought) { return n.id < sought; });
  return at != necks.end() && at->id == id ? static_cast<std::int32_t>(at - necks.begin()) : -1;
}

void MakeStamps(const SplatUniforms& u, Bands bands, std::span<const Drop> drops, std::span<const Neck> necks, StampChunk& out) {
  const int n = Lanes::size(), drop_count = static_cast<int>(drops.size()), height = static_cast<int>(u.size[1]);
  const float shear = u.frame[1] / u.frame[2];
  const float columns = wider * __builtin_sqrtf(1.0f + shear * shear) / u.frame[0], rows = wider / u.frame[2];
  HWY_ALIGN float in[4][HWY_MAX_BYTES / sizeof(float)] = {}, made[11][HWY_MAX_BYTES / sizeof(float)];
  HWY_ALIGN float neck_in[4][HWY_MAX_BYTES / sizeof(float)] = {}, neck_made[10][HWY_MAX_BYTES / sizeof(float)];
  const bool are_leaning = leans(u), have_necks = !necks.empty();
  const float round_reach = lean_reach(u);
  StampRecord seen[drops_of_chunk];
  std::vector<LeanRecord> lean(are_leaning ? drops.size() : 0);
  std::vector<std::int32_t> neck_of(have_necks ? drops.size() : 0, -1);
  out.necks.clear();
  int seen_count = 0;
  std::array<std::uint32_t, Bands::most + 1> count{};
  for (int first = 0; first < drop_count; first += n) {
    const int lanes = std::min(n, drop_count - first);
    for (int k = 0; k < lanes; ++k) {
      const Drop& d = drops[static_cast<std::size_t>(first + k)];
      in[0][k] = d.position[0];
      in[1][k] = d.position[1];
      in[2][k] = d.mass;
      in[3][k] = d.life;
    }
    const Stamp<Lanes> s = splat_stamp(u, Lanes::load(in[0]), Lanes::load(in[1]), Lanes::load(in[2]), Lanes::load(in[3]));
    const Lanes fields[5] = {s.x, s.y, s.radius, s.inverse_radius_sq, s.height};
    for (int f = 0; f < 5; ++f) hn::Store(fields[f].v, Lanes::D(), made[f]);
    if (are_leaning) {
      const Lanes leaning[6] = {s.lean_x, s.lean_y, s.inverse_length, s.inverse_radius, s.taper, s.skew};
      for (int f = 0; f < 6; ++f) hn::Store(leaning[f].v, Lanes::D(), made[5 + f]);
    }
    std::int32_t places[HWY_MAX_BYTES / sizeof(float)];
    bool is_any = false;
    for (int k = 0; have_necks && k < lanes; ++k)
      is_any |= (places[k] = place_of(necks, drops[static_cast<std::size_t>(first + k)].id)) >= 0;
    if (is_any) {
      for (int k = 0; k < lanes; ++k) {
        const Neck neck = places[k] < 0 ? Neck{} : necks[static_cast<std::size_t>(places[k])];
        neck_in[0][k] = neck.offset[0];
        neck_in[1][k] = neck.offset[1];
        neck_in[2][k] = neck.share;
        neck_in[3][k] = neck.left;
      }
      NeckState<Lanes> neck;
      int field = 0;
      NeckState<Lanes>::each(neck, [&](Lanes& number) HWY_ATTR { number = Lanes::load(neck_in[field++]); });
      const Stamp<Lanes> two = splat_stamp(u, Lanes::load(in[0]), Lanes::load(in[1]), Lanes::load(in[2]), Lanes::load(in[3]), &neck);
      const Lanes stamped[10] = {two.neck_x,        two.neck_y, two.larger,         two.larger_slope,   two.smaller,
                                 two.smaller_slope, two.fillet, two.inverse_fillet, two.inverse_radius, two.height};
      for (int f = 0; f < 10; ++f) hn::Store(stamped[f].v, Lanes::D(), neck_made[f]);
      if (are_leaning) {
        const Lanes leaning[3] = {two.inverse_length, two.taper, two.skew};
        constexpr int to[3] = {7, 9, 10};
        HWY_ALIGN float of_two[HWY_MAX_BYTES / sizeof(float)];
        for (int f = 0; f < 3; ++f) {
          hn::Store(leaning[f].v, Lanes::D(), of_two);
          for (int k = 0; k < lanes; ++k)
            if (places[k] >= 0) made[to[f]][k] = of_two[k];
        }
      }
      for (int k = 0; k < lanes; ++k)
        if (places[k] >= 0) made[4][k] = neck_made[9][k];
    }
    for (int k = 0; k < lanes; ++k) {
      const bool has_neck = is_any && places[k] >= 0;
      const float reach = has_neck ? neck_reach * round_reach : round_reach;
      const float x = made[0][k], y = made[1][k], radius = reach * made[2][k];
      const float half_width = radius * columns + more, half_height = radius * rows + more;
      const int first_row = past(y - half_height, height), end_row = past(y + half_height - 1, height);
      if (!(made[4][k] > 0 && x + half_width > 0 && x - half_width < u.size[0] && first_row < end_row)) continue;
      if (are_leaning)
        lean[static_cast<std::size_t>(seen_count)] = {made[5][k], made[6][k], made[7][k], made[8][k], made[9][k], made[10][k]};
      if (has_neck) {
        neck_of[static_cast<std::size_t>(seen_count)] = static_cast<std::int32_t>(out.necks.size());
        out.necks.push_back({neck_made[0][k], neck_made[1][k], neck_made[2][k], neck_made[3][k], neck_made[4][k], neck_made[5][k],
                             neck_made[6][k], neck_made[7][k], neck_made[8][k]});
      }
      seen[seen_count++] = {x, y, radius, made[3][k], made[4][k], half_width, first_row, end_row};
      for (int band = first_row / bands.rows; band <= (end_row - 1) / bands.rows; ++band) ++count[static_cast<std::size_t>(band)];
    }
  }
  std::uint32_t total = 0;
  for (std::size_t band = 0; band <= Bands::most; ++band) {
    out.first[band] = total;
    total += count[band];
  }
  if (out.stamps.size() < total) out.stamps.resize(total);
  if (are_leaning && out.leans.size() < total) out.leans.resize(total);
  if (out.necks.empty())
    out.neck_of.clear();
  else
    out.neck_of.resize(std::max<std::size_t>(out.neck_of.size(), total));
  auto next = out.first;
  for (int i = 0; i < seen_count; ++i) {
    for (int band = seen[i].first_row / bands.rows; band <= (seen[i].end_row - 1) / bands.rows; ++band) {
      const std::size_t to = next[static_cast<std::size_t>(band)]++;
      out.stamps[to] = seen[i];
      if (are_leaning) out.leans[to] = lean[static_cast<std::size_t>(i)];
      if (!out.necks.empty()) out.neck_of[to] = neck_of[static_cast<std::size_t>(i)];
    }
  }
}

/// Target of a band: halves of the texture itself, or floats that are stored after all drops.
template <SplatKernel kernel, bool is_leaning, bool has_neck, class Target>
HWY_INLINE HWY_ATTR void draw(const SplatUniforms& u, Rounding rounding, const StampRecord& r, const LeanRecord* lean,
                              const NeckRecord* neck, int row0, int row1, int width, const Target& row_of) {
  const int n = Lanes::size();
  const SplatBlend blend = static_cast<SplatBlend>(u.blend);
  Stamp<Lanes> s;
  s.x = Lanes(r.x);
  s.y = Lanes(r.y);
  s.inverse_radius_sq = Lanes(r.inverse_radius_sq);
  s.height = Lanes(r.height);
  if constexpr (is_leaning) {
    s.lean_x = Lanes(lean->x);
    s.lean_y = Lanes(lean->y);
    s.inverse_length = Lanes(lean->inverse_length);
    s.inverse_radius = Lanes(lean->inverse_radius);
    s.taper = Lanes(lean->taper);
    s.skew = Lanes(lean->skew);
  }
  if constexpr (has_neck) {
    s.neck_x = Lanes(neck->x);
    s.neck_y = Lanes(neck->y);
    s.larger = Lanes(neck->larger);
    s.larger_slope = Lanes(neck->larger_slope);
    s.smaller = Lanes(neck->smaller);
    s.smaller_slope = Lanes(neck->smaller_slope);
    s.fillet = Lanes(neck->fillet);
    s.inverse_fillet = Lanes(neck->inverse_fillet);
    s.inverse_radius = Lanes(neck->inverse_radius);
  }
  const auto blend_at = [&](auto* row, int x, float fy) RAINREF_LAMBDA {
    const Lanes drop = splat_contribution<is_leaning, has_neck>(u, kernel, s, Lanes::index(x) + Lanes(0.5f), Lanes(fy));
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

// Calls drawn(stamp, its lean or null, its neck or null) for every stamp of the band, in slot order.
template <class Drawn>
HWY_INLINE HWY_ATTR void for_stamps_of(std::span<const StampChunk> chunks, int band, const Drawn& drawn) {
  const std::size_t b = static_cast<std::size_t>(band);
  for (const StampChunk& chunk : chunks) {
    for (std::uint32_t i = chunk.first[b]; i < chunk.first[b + 1]; ++i) {
      const std::int32_t neck = chunk.neck_of.empty() ? -1 : chunk.neck_of[i];
      drawn(chunk.stamps[i], chunk.leans.empty() ? nullptr : &chunk.leans[i],
            neck < 0 ? nullptr : &chunk.necks[static_cast<std::size_t>(neck)]);
    }
  }
}

// Copies a row of the film, with its end texels repeated on both sides.
HWY_INLINE void copy_film_row(const Image& film, int y, float* to) {
  const int width = film.width();
  const float* from = film.row<float>(std::clamp(y, 0, film.height() - 1));
  std::copy_n(from, width, to + 1);
  to[0] = from[0];
  to[width + 1] = from[width - 1];
}

template <SplatKernel kernel, bool is_leaning>
void band_of(const SplatJob& job, Bands bands, int band, std::span<const StampChunk> chunks) {
  const SplatUniforms u = job.uniforms;
  Image& image = *job.height;
  const int n = Lanes::size(), width = image.width(), y0 = band * bands.rows, y1 = std::min(image.height(), y0 + bands.rows);
  const auto rows_of = [&](const StampRecord& r, const LeanRecord* lean, const NeckRecord* neck, auto&& row_of) RAINREF_LAMBDA {
    const int row0 = std::max(y0, r.first_row), row1 = std::min(y1, r.end_row);
    if (neck)
      draw<kernel, is_leaning, true>(u, job.rounding, r, lean, neck, row0, row1, width, row_of);
    else
      draw<kernel, is_leaning, false>(u, job.rounding, r, lean, neck, row0, row1, width, row_of);
  };
  if (job.half_accumulation) {
    for (int y = y0; y < y1; ++y) std::memset(image.row<Half>(y), 0, static_cast<std::size_t>(width) * sizeof(Half));
    for_stamps_of(chunks, band, [&](const StampRecord& r, const LeanRecord* lean, const NeckRecord* neck) RAINREF_LAMBDA {
      rows_of(r, lean, neck, [&](int y) RAINREF_LAMBDA { return image.row<Half>(y); });
    });
    return;
  }
  const std::size_t pitch = static_cast<std::size_t>(width + n);
  std::vector<float> sums(pitch * static_cast<std::size_t>(y1 - y0));
  const auto sum_row = [&](int y) RAINREF_LAMBDA { return sums.data() + pitch * static_cast<std::size_t>(y - y0); };
  for_stamps_of(chunks, band, [&](const StampRecord& r, const LeanRecord* lean, const NeckRecord* neck) RAINREF_LAMBDA {
    rows_of(r, lean, neck, sum_row);
  });
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
template <bool is_leaning>
void band_of_kernel(const SplatJob& job, Bands bands, int band, std::span<const StampChunk> chunks) {
  switch (static_cast<SplatKernel>(job.uniforms.kernel)) {
    case SplatKernel::paraboloid:
      return band_of<SplatKernel::paraboloid, is_leaning>(job, bands, band, chunks);
    case SplatKernel::quartic:
      return band_of<SplatKernel::quartic, is_leaning>(job, bands, band, chunks);
    case SplatKernel::smoothstep:
      return band_of<SplatKernel::smoothstep, is_leaning>(job, bands, band, chunks);
    case SplatKernel::hemisphere:
      return band_of<SplatKernel::hemisphere, is_leaning>(job, bands, band, chunks);
    case SplatKernel::disc:
      return band_of<SplatKernel::disc, is_leaning>(job, bands, band, chunks);
  }
}
void SplatBand(const SplatJob& job, Bands bands, int band, std::span<const StampChunk> chunks) {
  leans(job.uniforms) ? band_of_kernel<true>(job, bands, band, chunks) : band_of_kernel<false>(job, bands, band, chunks);
}
#undef RAINREF_LAMBDA
RAINREF_TARGET_END(drops)

#if RAINREF_ONCE
namespace rainref::drops {

RAINREF_EXPORT(MakeStamps);
RAINREF_EXPORT(SplatBand);

Bands splat_bands(int height) {
  // Gives more bands than processors have cores, but bands high enough that a drop rarely reaches several.
  constexpr int fewest_rows = 16;
  const int rows = std::max(fewest_rows, (height + Bands::most - 1) / Bands::most);
  return {rows, (height + rows - 1) / rows};
}
void make_stamps(const SplatUniforms& uniforms, Bands bands, std::span<const Drop> drops, std::span<const Neck> necks, StampChunk& out) {
  RAINREF_DISPATCH(MakeStamps)(uniforms, bands, drops, necks, out);
}
void splat_band(const SplatJob& job, Bands bands, int band, std::span<const StampChunk> chunks) {
  RAINREF_DISPATCH(SplatBand)(job, bands, band, chunks);
}

}  // namespace rainref::drops
#endif
