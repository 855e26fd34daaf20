// Shells of raindrops and wave_step; compiled once for each SIMD target.
#include <algorithm>

#include "puddle/kernels.h"

#define RAINREF_KERNELS "puddle/kernels_wave.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "puddle/raindrops.pass.h"
#include "puddle/wave_step.pass.h"
#undef RAINREF_FN

int row_index(int y, int height, Boundary boundary) {
  if (0 <= y && y < height) return y;
  if (boundary == Boundary::periodic) return ((y % height) + height) % height;
  return y < 0 ? 0 : height - 1;
}
template <class Storage>
const Storage* row_of(const WaveJob& job, int y) {
  const Image& plane = *job.newest;
  if (job.boundary == Boundary::fixed && (y < 0 || y >= plane.height())) return job.rest_row->row<Storage>(0);
  return plane.row<Storage>(row_index(y, plane.height(), job.boundary));
}

template <class Storage>
void fill_row_ghosts(Storage* row, int width, Boundary boundary, Storage rest) {
  for (int k = 0; k < Image::left_margin; ++k) {
    const int left = -1 - k, right = width + k;
    row[left] = boundary == Boundary::fixed ? rest : row[boundary == Boundary::periodic ? ((left % width) + width) % width : 0];
    row[right] = boundary == Boundary::fixed ? rest : row[boundary == Boundary::periodic ? right % width : width - 1];
  }
}
template <class Storage>
Storage encode_one(float x, Rounding rounding) {
  Storage s;
  store(&s, Lanes(x), rounding, 1);
  return s;
}

// The drops that reach into columns [x0, x1) of the row at centre height fy, in order.
int near_drops(std::span<const Drop> drops, const std::vector<int>& in_row, int x0, int x1, std::vector<Drop>& out) {
  out.clear();
  for (const int i : in_row) {
    const Drop& d = drops[static_cast<std::size_t>(i)];
    if (d.x + d.radius >= static_cast<float>(x0) && d.x - d.radius <= static_cast<float>(x1)) out.push_back(d);
  }
  return static_cast<int>(out.size());
}
void drops_in_row(std::span<const Drop> drops, int y, std::vector<int>& out) {
  out.clear();
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const Drop& d = drops[i];
    if (d.y + d.radius >= static_cast<float>(y) && d.y - d.radius <= static_cast<float>(y + 1)) out.push_back(static_cast<int>(i));
  }
}

template <class Storage>
void step_rows(const WaveJob& job, const parallel::Tile& tile) {
  const int n = Lanes::size(), width = job.newest->width();
  WaveRows<Storage> rows;
  // With a whole offset r the neighbours are r away; with a fractional one between r and r + 1.
  rows.reach = job.corrected ? 1 : static_cast<int>(job.uniforms.step);
  rows.fraction = job.corrected ? 0.0f : job.uniforms.step - static_cast<float>(rows.reach);
  std::vector<int> in_row;
  std::vector<Drop> near;
  for (int y = tile.y0; y < tile.y1; ++y) {
    rows.here = job.newest->row<Storage>(y);
    rows.below = row_of<Storage>(job, y - rows.reach);
    rows.above = row_of<Storage>(job, y + rows.reach);
    rows.below_next = row_of<Storage>(job, y - rows.reach - 1);
    rows.above_next = row_of<Storage>(job, y + rows.reach + 1);
    Storage* out = job.previous->row<Storage>(y);
    rows.previous = out;
    rows.shore = job.shore ? job.shore->row<float>(y) : nullptr;
    drops_in_row(job.drops, y, in_row);
    for (int x = 0; x < width; x += n) {
      const int count = std::min(n, width - x);
      const int drop_count = in_row.empty() ? 0 : near_drops(job.drops, in_row, x, x + count, near);
      const Lanes next = job.corrected ? wave_step_corrected<Lanes>(job.uniforms, rows, near.data(), drop_count, x, y)
                                       : wave_step_as_published<Lanes>(job.uniforms, rows, near.data(), drop_count, x, y);
      store(out + x, next, job.rounding, count);
    }
    fill_row_ghosts(out, width, job.boundary, encode_one<Storage>(job.uniforms.rest, job.rounding));
  }
}
void StepRows(const WaveJob& job, const parallel::Tile& tile) {
  switch (info(job.newest->format()).kind) {
    case FormatInfo::float16:
      return step_rows<Half>(job, tile);
    case FormatInfo::float32:
      return step_rows<float>(job, tile);
    default:
      return step_rows<Unorm8>(job, tile);
  }
}

template <class Storage>
void previous_rows(const WaveJob& job, Image& plane, const parallel::Tile& tile) {
  const int n = Lanes::size(), width = plane.width();
  std::vector<int> in_row;
  std::vector<Drop> near;
  for (int y = tile.y0; y < tile.y1; ++y) {
    drops_in_row(job.drops, y, in_row);
    if (in_row.empty()) continue;
    Storage* row = plane.row<Storage>(y);
    const float* shore = job.shore ? job.shore->row<float>(y) : nullptr;
    for (int x = 0; x < width; x += n) {
      const int count = std::min(n, width - x), drop_count = near_drops(job.drops, in_row, x, x + count, near);
      if (drop_count == 0) continue;
      store(row + x, wave_previous_corrected<Lanes>(row, shore, near.data(), drop_count, x, y), job.rounding, count);
    }
    fill_row_ghosts(row, width, job.boundary, encode_one<Storage>(job.uniforms.rest, job.rounding));
  }
}
void PreviousRows(const WaveJob& job, Image& plane, const parallel::Tile& tile) {
  switch (info(plane.format()).kind) {
    case FormatInfo::float16:
      return previous_rows<Half>(job, plane, tile);
    case FormatInfo::float32:
      return previous_rows<float>(job, plane, tile);
    default:
      return previous_rows<Unorm8>(job, plane, tile);
  }
}

template <class Storage>
void encode(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  const int n = Lanes::size(), width = plane.width();
  HWY_ALIGN float block[HWY_MAX_BYTES / sizeof(float)] = {};
  for (int y = 0; y < plane.height(); ++y) {
    Storage* row = plane.row<Storage>(y);
    for (int x = 0; x < width; x += n) {
      const int count = std::min(n, width - x);
      std::copy_n(stored + static_cast<std::size_t>(y) * width + x, count, block);
      store(row + x, Lanes::load(block), rounding, count);
    }
    fill_row_ghosts(row, width, boundary, encode_one<Storage>(rest, rounding));
  }
}
void EncodeRows(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  switch (info(plane.format()).kind) {
    case FormatInfo::float16:
      return encode<Half>(stored, plane, boundary, rest, rounding);
    case FormatInfo::float32:
      return encode<float>(stored, plane, boundary, rest, rounding);
    default:
      return encode<Unorm8>(stored, plane, boundary, rest, rounding);
  }
}

template <class Storage>
void decode(const Image& plane, float* out, const parallel::Tile& tile) {
  const int n = Lanes::size(), width = plane.width();
  for (int y = tile.y0; y < tile.y1; ++y) {
    const Storage* row = plane.row<Storage>(y);
    float* to = out + static_cast<std::size_t>(y) * width;
    for (int x = 0; x < width; x += n) store(to + x, Lanes::load(row + x), Rounding::rne, std::min(n, width - x));
  }
}
void DecodeRows(const Image& plane, float* out, const parallel::Tile& tile) {
  switch (info(plane.format()).kind) {
    case FormatInfo::float16:
      return decode<Half>(plane, out, tile);
    case FormatInfo::float32:
      return decode<float>(plane, out, tile);
    default:
      return decode<Unorm8>(plane, out, tile);
  }
}

// A maximum does not depend on the order of its operands, so lanes may hold partial ones.
float largest(Lanes x) {
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(x.v, Lanes::D(), lanes);
  return *std::max_element(lanes, lanes + Lanes::size());
}
void ExtentsOfRows(const float* decoded, int width, int height, float rest, const parallel::Tile& tile, Extent* blocks) {
  const int n = Lanes::size();
  const auto magnitude = [](float x) { return x < 0 ? -x : x; };
  for (int x0 = 0; x0 < width; x0 += extent_block) {
    const int x1 = std::min(width, x0 + extent_block);
    Lanes top(0.0f), step(0.0f);
    float tail_top = 0, tail_step = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *row = decoded + static_cast<std::size_t>(y) * width, *next = y + 1 < height ? row + width : row;
      // The water falls to the rest level beyond its edge.
      if (x0 == 0) tail_step = std::max(tail_step, magnitude(row[0] - rest));
      if (x1 == width) tail_step = std::max(tail_step, magnitude(row[width - 1] - rest));
      if (y == 0 || y + 1 == height) {
        for (int x = x0; x < x1; ++x) tail_step = std::max(tail_step, magnitude(row[x] - rest));
      }
      int x = x0;
      for (; x + n <= x1 && x + n < width; x += n) {
        const Lanes here = Lanes::load(row + x);
        top = max(top, abs(here - Lanes(rest)));
        step = max(step, max(abs(Lanes::load(row + x + 1) - here), abs(Lanes::load(next + x) - here)));
      }
      for (; x < x1; ++x) {
        tail_top = std::max(tail_top, magnitude(row[x] - rest));
        if (x + 1 < width) tail_step = std::max(tail_step, magnitude(row[x + 1] - row[x]));
        tail_step = std::max(tail_step, magnitude(next[x] - row[x]));
      }
    }
    *blocks++ = {std::max(tail_top, largest(top)), std::max(tail_step, largest(step))};
  }
}

void RaindropsAsPublished(const RaindropsUniforms& uniforms, Drop* out) {
  const int n = Lanes::size();
  for (int i = 0; i < uniforms.drop_count; i += n) {
    const Vec3<Lanes> drop = raindrop_as_published<Lanes>(uniforms, i);
    HWY_ALIGN float x[HWY_MAX_BYTES / sizeof(float)], y[HWY_MAX_BYTES / sizeof(float)], strength[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(drop.x.v, Lanes::D(), x);
    hn::Store(drop.y.v, Lanes::D(), y);
    hn::Store(drop.z.v, Lanes::D(), strength);
    for (int k = 0; k < std::min(n, uniforms.drop_count - i); ++k) out[i + k] = {x[k], y[k], strength[k] + 0.0f, 4.0f};
  }
}
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
namespace rainref::puddle {

RAINREF_EXPORT(StepRows);
RAINREF_EXPORT(PreviousRows);
RAINREF_EXPORT(EncodeRows);
RAINREF_EXPORT(DecodeRows);
RAINREF_EXPORT(ExtentsOfRows);
RAINREF_EXPORT(RaindropsAsPublished);

void encode_rows(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  RAINREF_DISPATCH(EncodeRows)(stored, plane, boundary, rest, rounding);
}
void wave_step_rows(const WaveJob& job, const parallel::Tile& tile) { RAINREF_DISPATCH(StepRows)(job, tile); }
void wave_previous_rows(const WaveJob& job, Image& plane, const parallel::Tile& tile) { RAINREF_DISPATCH(PreviousRows)(job, plane, tile); }
void decode_rows(const Image& plane, float* out, const parallel::Tile& tile) { RAINREF_DISPATCH(DecodeRows)(plane, out, tile); }
void extents_of_rows(const float* decoded, int width, int height, float rest, const parallel::Tile& tile, Extent* blocks) {
  RAINREF_DISPATCH(ExtentsOfRows)(decoded, width, height, rest, tile, blocks);
}
std::vector<Drop> raindrops_as_published(const RaindropsUniforms& uniforms) {
  std::vector<Drop> drops(static_cast<std::size_t>(std::max(0, uniforms.drop_count)));
  RAINREF_DISPATCH(RaindropsAsPublished)(uniforms, drops.data());
  return drops;
}

}  // namespace rainref::puddle
#endif
