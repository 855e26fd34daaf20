// Shell of wave_step; compiled once for each SIMD target.
#include <algorithm>

#include "pass/planes.h"
#include "puddle/kernels.h"
#include "puddle/wave_step.pass.h"

#define RAINREF_KERNELS "puddle/kernels_wave.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "puddle/wave_step.pass.h"
#undef RAINREF_FN

// ---- the drops of a place ------------------------------------------------------------------------------------------
// A drop adds exactly nothing beyond its radius, so that any choice which holds those that reach into a place gives its bits.
void drops_in_rows(std::span<const Drop> drops, int y0, int y1, std::vector<Drop>& out) {
  out.clear();
  for (const Drop& d : drops)
    if (d.y + d.radius >= static_cast<float>(y0) && d.y - d.radius <= static_cast<float>(y1)) out.push_back(d);
}
void drops_in_columns(std::span<const Drop> drops, int x0, int x1, std::vector<Drop>& out) {
  out.clear();
  for (const Drop& d : drops)
    if (d.x + d.radius >= static_cast<float>(x0) && d.x - d.radius <= static_cast<float>(x1)) out.push_back(d);
}
// Columns [x0, x1) from left to right: without(begin, end) where no drop of the row reaches, with(x, drops) for a vector where some may.
// x0 and every begin are multiples of a vector's length.
template <class Without, class With>
HWY_INLINE HWY_ATTR void for_drops(std::span<const Drop> in_row, int x0, int x1, const Without& without, const With& with) {
  const int n = Lanes::size();
  std::vector<Drop> near;
  int done = x0;
  while (done < x1) {
    // The next vector that a drop reaches into.
    int next = x1;
    for (const Drop& d : in_row) {
      if (d.x + d.radius < static_cast<float>(done)) continue;
      const float first = d.x - d.radius - 1.0f;
      if (first >= static_cast<float>(next)) continue;
      next = first <= static_cast<float>(done) ? done : static_cast<int>(first) / n * n;
    }
    if (next > done) without(done, next);
    if (next < x1) {
      drops_in_columns(in_row, next, next + n, near);
      with(next, std::span<const Drop>(near));
    }
    done = next + n;
  }
}

// ---- rows of the newest level ----------------------------------------------------------------------------------------
// As wave_step reads them in columns [x0, x1) of a tile: floats where they stand; other storage decoded once and not for each neighbour.
template <class Storage>
class NewestRows {
 public:
  static constexpr int columns = 4096;  // of a strip: its rows stay in a cache
  NewestRows(const WaveJob& job, int reach) : job_(job), rows_(2 * reach + 1), ring_(static_cast<std::size_t>(rows_) * stride) {}
  /// Row y is read from now on; rows must come in ascending order within a strip.
  HWY_ATTR void add(int y, int x0, int x1) {
    const Storage* from = pass::row_at<Storage>(*job_.newest, *job_.rest_row, edge(), y);
    float* to = line(y);
    for (int x = x0 - margin; x < x1 + margin; x += Lanes::size()) hn::StoreU(Lanes::load(from + x).v, Lanes::D(), to + margin + x - x0);
    x0_ = x0;
  }
  const float* row(int y) const { return const_cast<NewestRows*>(this)->line(y) + margin - x0_; }

 private:
  static constexpr int margin = Image::left_margin;
  static constexpr std::size_t stride = columns + 2 * margin + HWY_MAX_BYTES / sizeof(float);
  Address edge() const { return address_of(job_.boundary); }
  float* line(int y) { return ring_.data() + static_cast<std::size_t>((y + rows_ * margin) % rows_) * stride; }
  const WaveJob& job_;
  int rows_, x0_ = 0;
  std::vector<float> ring_;
};
template <>
class NewestRows<float> {
 public:
  static constexpr int columns = 1 << 30;
  NewestRows(const WaveJob& job, int) : job_(job) {}
  void add(int, int, int) {}
  const float* row(int y) const { return pass::row_at<float>(*job_.newest, *job_.rest_row, address_of(job_.boundary), y); }

 private:
  const WaveJob& job_;
};

// Without it the compiler calls some of these, and what they refer to lives in memory.
#undef RAINREF_INLINED
#define RAINREF_INLINED HWY_ATTR __attribute__((always_inline))

// ---- steps -----------------------------------------------------------------------------------------------------------
// Columns [begin, end) of a row by value(column). Values and not references come in, so that no store can change them.
template <Rounding rounding, class Storage, class Value>
HWY_INLINE HWY_ATTR void store_columns(Storage* out, int begin, int end, const Value& value) {
  constexpr int n = Lanes::size();
  int x = begin;
  for (; x + n <= end; x += n) store(out + x, value(x), rounding, n);
  if (x < end) store(out + x, value(x), rounding, end - x);
}
template <bool corrected, Rounding rounding, class Storage>
HWY_NOINLINE HWY_ATTR void step_columns(WaveStepUniforms u, WaveRows<float, Storage> rows, Storage* out, int begin, int end, int y) {
  constexpr std::span<const Drop> none;
  if constexpr (corrected) {
    if (u.rim_damping > 0.0f) {
      store_columns<rounding>(out, begin, end, [&](int x) RAINREF_INLINED { return wave_step_corrected<Lanes>(u, rows, none, x, y); });
    } else if (rows.shore) {
      u.rim_damping = 0.0f;  // known from here on
      store_columns<rounding>(out, begin, end, [&](int x) RAINREF_INLINED { return wave_step_corrected<Lanes>(u, rows, none, x, y); });
    } else {
      u.rim_damping = 0.0f;
      rows.shore = nullptr;
      store_columns<rounding>(out, begin, end, [&](int x) RAINREF_INLINED { return wave_step_corrected<Lanes>(u, rows, none, x, y); });
    }
  } else if (rows.fraction != 0.0f) {
    store_columns<rounding>(out, begin, end, [&](int x) RAINREF_INLINED { return wave_step_as_published<Lanes>(u, rows, none, x, y); });
  } else {
    rows.fraction = 0.0f;
    store_columns<rounding>(out, begin, end, [&](int x) RAINREF_INLINED { return wave_step_as_published<Lanes>(u, rows, none, x, y); });
  }
}
template <bool corrected, Rounding rounding, class Storage>
HWY_ATTR void step_rows(const WaveJob& job, const parallel::Tile& tile) {
  const WaveStepUniforms u = job.uniforms;
  const int n = Lanes::size(), width = job.newest->width();
  const int reach = corrected ? 1 : static_cast<int>(__builtin_ceilf(u.step));
  std::vector<Drop> in_tile, in_row;
  drops_in_rows(job.drops, tile.y0, tile.y1, in_tile);
  NewestRows<Storage> newest(job, reach);
  for (int x0 = 0; x0 < width; x0 += std::min(width, newest.columns)) {
    const int x1 = std::min(width - x0, newest.columns) + x0;
    for (int y = tile.y0 - reach; y < tile.y0 + reach; ++y) newest.add(y, x0, x1);
    for (int y = tile.y0; y < tile.y1; ++y) {
      newest.add(y + reach, x0, x1);
      Storage* out = job.previous->row<Storage>(y);
      const auto row = [&](int dy) HWY_ATTR { return newest.row(y + std::clamp(dy, -reach, reach)); };
      const WaveRows<float, Storage> rows = rows_around<float>(u, corrected, row, out, job.shore ? job.shore->row<float>(y) : nullptr);
      drops_in_rows(in_tile, y, y + 1, in_row);
      for_drops(
          in_row, x0, x1, [&](int begin, int end) { step_columns<corrected, rounding>(u, rows, out, begin, end, y); },
          [&](int x, std::span<const Drop> drops) HWY_ATTR {
            store_columns<rounding>(out, x, std::min(x + n, x1), [&](int at) RAINREF_INLINED {
              if constexpr (corrected)
                return wave_step_corrected<Lanes>(u, rows, drops, at, y);
              else
                return wave_step_as_published<Lanes>(u, rows, drops, at, y);
            });
          });
    }
  }
  for (int y = tile.y0; y < tile.y1; ++y)
    pass::fill_margins(job.previous->row<Storage>(y), width, address_of(job.boundary), *job.rest_row->row<Storage>(0));
}
// f with the variant and the rounding as constants.
template <class F>
HWY_ATTR void with_constants(const WaveJob& job, const F& f) {
  using Corrected = std::true_type;
  using AsPublished = std::false_type;
  using Nearest = std::integral_constant<Rounding, Rounding::rne>;
  using TowardZero = std::integral_constant<Rounding, Rounding::rtz>;
  if (job.rounding == Rounding::rne)
    job.corrected ? f(Corrected(), Nearest()) : f(AsPublished(), Nearest());
  else
    job.corrected ? f(Corrected(), TowardZero()) : f(AsPublished(), TowardZero());
}
void StepRows(const WaveJob& job, const parallel::Tile& tile) {
  pass::in_storage(job.newest->format(), [&]<class Storage>(Storage) HWY_ATTR {
    with_constants(job, [&](auto corrected, auto rounding) HWY_ATTR { step_rows<corrected(), rounding(), Storage>(job, tile); });
  });
}

template <class Storage>
HWY_ATTR void previous_rows(const WaveJob& job, const parallel::Tile& tile) {
  const int width = job.newest->width();
  std::vector<Drop> in_tile, in_row;
  drops_in_rows(job.drops, tile.y0, tile.y1, in_tile);
  for (int y = tile.y0; y < tile.y1; ++y) {
    drops_in_rows(in_tile, y, y + 1, in_row);
    if (in_row.empty()) continue;
    Storage* row = job.newest->row<Storage>(y);
    const float* shore = job.shore ? job.shore->row<float>(y) : nullptr;
    for_drops(
        in_row, 0, width, [](int, int) {},
        [&](int x, std::span<const Drop> drops) HWY_ATTR {
          store(row + x, wave_previous_corrected<Lanes>(row, shore, drops, x, y), job.rounding, std::min(Lanes::size(), width - x));
        });
    pass::fill_margins(row, width, address_of(job.boundary), *job.rest_row->row<Storage>(0));
  }
}
void PreviousRows(const WaveJob& job, const parallel::Tile& tile) {
  pass::in_storage(job.newest->format(), [&]<class Storage>(Storage) HWY_ATTR { previous_rows<Storage>(job, tile); });
}
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
namespace rainref::puddle {

RAINREF_EXPORT(StepRows);
RAINREF_EXPORT(PreviousRows);

void wave_step_rows(const WaveJob& job, const parallel::Tile& tile) { RAINREF_DISPATCH(StepRows)(job, tile); }
void wave_previous_rows(const WaveJob& job, const parallel::Tile& tile) { RAINREF_DISPATCH(PreviousRows)(job, tile); }

}  // namespace rainref::puddle
#endif
