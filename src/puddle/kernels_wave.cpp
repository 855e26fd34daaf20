// Shells of raindrops and wave_step; compiled once for each SIMD target.
#include <algorithm>

#include "pass/planes.h"
#include "puddle/kernels.h"
#include "puddle/raindrops.pass.h"
#include "puddle/wave_step.pass.h"

#define RAINREF_KERNELS "puddle/kernels_wave.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "puddle/raindrops.pass.h"
#include "puddle/wave_step.pass.h"
#undef RAINREF_FN

Address address_of(Boundary boundary) {
  return boundary == Boundary::periodic ? Address::repeat : boundary == Boundary::fixed ? Address::border : Address::clamp;
}
template <class Storage>
Storage encode_one(float x, Rounding rounding) {
  Storage s;
  store(&s, Lanes(x), rounding, 1);
  return s;
}

// The drops that reach into columns [x0, x1) of the row at centre height fy, in order.
std::span<const Drop> near_drops(std::span<const Drop> drops, const std::vector<int>& in_row, int x0, int x1, std::vector<Drop>& out) {
  out.clear();
  for (const int i : in_row) {
    const Drop& d = drops[static_cast<std::size_t>(i)];
    if (d.x + d.radius >= static_cast<float>(x0) && d.x - d.radius <= static_cast<float>(x1)) out.push_back(d);
  }
  return out;
}
void drops_in_row(std::span<const Drop> drops, int y, std::vector<int>& out) {
  out.clear();
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const Drop& d = drops[i];
    if (d.y + d.radius >= static_cast<float>(y) && d.y - d.radius <= static_cast<float>(y + 1)) out.push_back(static_cast<int>(i));
  }
}

// A row, by `step` (column, columns) in whole vectors and one of the rest: the compiler knows the length of all but the last.
template <class Storage, class Step>
HWY_INLINE HWY_ATTR void step_row(int width, Storage* out, Rounding rounding, const Step& step) {
  const int n = Lanes::size();
  int x = 0;
  for (; x + n <= width; x += n) store(out + x, step(x, n), rounding, n);
  if (x < width) store(out + x, step(x, width - x), rounding, width - x);
}
template <class Storage>
void step_rows(const WaveJob& job, const parallel::Tile& tile) {
  const int width = job.newest->width();
  const Address edge = address_of(job.boundary);
  std::vector<int> in_row;
  std::vector<Drop> near;
  for (int y = tile.y0; y < tile.y1; ++y) {
    const auto newest = [&](int dy) HWY_ATTR { return pass::row_at<Storage>(*job.newest, *job.rest_row, edge, y + dy); };
    Storage* out = job.previous->row<Storage>(y);
    const WaveRows<Storage> rows =
        rows_around<Storage>(job.uniforms, job.corrected, newest, out, job.shore ? job.shore->row<float>(y) : nullptr);
    drops_in_row(job.drops, y, in_row);
    // What does not change along a row is asked once: the variant, and whether any drop reaches the row.
    if (!in_row.empty()) {
      step_row<Storage>(width, out, job.rounding, [&](int x, int count) HWY_ATTR {
        const std::span<const Drop> drops = near_drops(job.drops, in_row, x, x + count, near);
        return job.corrected ? wave_step_corrected<Lanes>(job.uniforms, rows, drops, x, y)
                             : wave_step_as_published<Lanes>(job.uniforms, rows, drops, x, y);
      });
    } else if (job.corrected) {
      step_row<Storage>(width, out, job.rounding,
                        [&](int x, int) HWY_ATTR { return wave_step_corrected<Lanes>(job.uniforms, rows, std::span<const Drop>(), x, y); });
    } else {
      step_row<Storage>(width, out, job.rounding, [&](int x, int) HWY_ATTR {
        return wave_step_as_published<Lanes>(job.uniforms, rows, std::span<const Drop>(), x, y);
      });
    }
    pass::fill_margins(out, width, edge, encode_one<Storage>(job.uniforms.rest, job.rounding));
  }
}
void StepRows(const WaveJob& job, const parallel::Tile& tile) {
  pass::in_storage(job.newest->format(), [&]<class Storage>(Storage) HWY_ATTR { step_rows<Storage>(job, tile); });
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
      const int count = std::min(n, width - x);
      const std::span<const Drop> drops = near_drops(job.drops, in_row, x, x + count, near);
      if (drops.empty()) continue;
      store(row + x, wave_previous_corrected<Lanes>(row, shore, drops, x, y), job.rounding, count);
    }
    pass::fill_margins(row, width, address_of(job.boundary), encode_one<Storage>(job.uniforms.rest, job.rounding));
  }
}
void PreviousRows(const WaveJob& job, Image& plane, const parallel::Tile& tile) {
  pass::in_storage(plane.format(), [&]<class Storage>(Storage) HWY_ATTR { previous_rows<Storage>(job, plane, tile); });
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
    pass::fill_margins(row, width, address_of(boundary), encode_one<Storage>(rest, rounding));
  }
}
void EncodeRows(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  pass::in_storage(plane.format(), [&]<class Storage>(Storage) HWY_ATTR { encode<Storage>(stored, plane, boundary, rest, rounding); });
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
  pass::in_storage(plane.format(), [&]<class Storage>(Storage) HWY_ATTR { decode<Storage>(plane, out, tile); });
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
    for (int k = 0; k < std::min(n, uniforms.drop_count - i); ++k) out[i + k] = {x[k], y[k], strength[k] + 0.0f, raindrop_radius};
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
