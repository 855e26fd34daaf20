// Shell of wave_step; compiled once for each SIMD target.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

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
void drops_in_rows(std::span<const Drop> drops, int y0, int y1, std::vector<Drop>& out) {
  out.clear();
  for (const Drop& d : drops)
    if (reaches_rows(d, y0, y1)) out.push_back(d);
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

// ---- rows at a time --------------------------------------------------------------------------------------------------
// A vector of a row and its neighbours, in registers: a load at an odd place takes as long as two, and may have to wait for a store that
// has the same place in another page.
struct LoadedRow {
  Lanes left, here, right;
  int x;
};
template <class N>
HWY_INLINE HWY_ATTR N element(const LoadedRow& row, int x) {
  return x == row.x ? row.here : x < row.x ? row.left : row.right;  // known when it is compiled
}
// What a step of the corrected pass reads besides the two levels. As constants, for each costs much of the time of a step.
enum class Edges { none, shore, rim };

// Without it the compiler calls some of these, and what they refer to lives in memory.
#undef RAINREF_INLINED
#define RAINREF_INLINED HWY_ATTR __attribute__((always_inline))

template <int... Rows, class F>
HWY_INLINE HWY_ATTR void for_each_row(std::integer_sequence<int, Rows...>, const F& f) {
  (f(std::integral_constant<int, Rows>()), ...);
}
// Whole vectors of columns [begin, end) that no drop reaches, of R rows from y on: each vector of the newest level is loaded once.
// Returns the first column that is left. Neighbours are one texel away.
template <int R, bool corrected, Edges edges, Rounding rounding, class Storage>
HWY_NOINLINE HWY_ATTR int step_block(WaveStepUniforms u, std::array<const Storage*, R + 2> newest, std::array<Storage*, R> out,
                                     std::array<const float*, R> shore, int begin, int end, int y) {
  constexpr int n = Lanes::size();
  constexpr std::integer_sequence each = std::make_integer_sequence<int, R>();
  constexpr std::span<const Drop> none;
  if (edges != Edges::rim) u.rim_damping = 0.0f;
  Lanes before[R], here[R], after[R], next[R];
  for_each_row(each, [&](auto k) RAINREF_INLINED {
    before[k] = Lanes::load(newest[k + 1] + begin - n);
    here[k] = Lanes::load(newest[k + 1] + begin);
  });
  int x = begin;
  for (; x + n <= end; x += n) {
    const Lanes below = Lanes::load(newest[0] + x), above = Lanes::load(newest[R + 1] + x);
    for_each_row(each, [&](auto k) RAINREF_INLINED { after[k] = Lanes::load(newest[k + 1] + x + n); });
    for_each_row(each, [&](auto k) RAINREF_INLINED {
      const auto row = [&](const Lanes& v) RAINREF_INLINED { return LoadedRow{v, v, v, x}; };
      const WaveRows<LoadedRow, Storage> rows{{Lanes::shifted_up(before[k], here[k]), here[k], Lanes::shifted_down(here[k], after[k]), x},
                                              row(k == 0 ? below : here[std::max(k - 1, 0)]),
                                              row(k == R - 1 ? above : here[std::min(k + 1, R - 1)]),
                                              {},
                                              {},
                                              out[k],
                                              1,
                                              0.0f,
                                              edges == Edges::none ? nullptr : shore[k]};
      if constexpr (corrected)
        next[k] = wave_step_corrected<Lanes>(u, rows, none, x, y + k);
      else
        next[k] = wave_step_as_published<Lanes>(u, rows, none, x, y + k);
    });
    for_each_row(each, [&](auto k) RAINREF_INLINED {
      // Nothing stored is -0, so that neither is a sum that begins with what is stored, or with 1/2.
      store_without_minus_zero(out[k] + x, next[k], rounding);
      before[k] = here[k];
      here[k] = after[k];
    });
  }
  return x;
}

// ---- steps -----------------------------------------------------------------------------------------------------------
template <bool corrected, Edges edges, Rounding rounding, class Storage>
class Rows {
 public:
  explicit Rows(const WaveJob& job) : job_(job), u_(job.uniforms) {}
  // Vectors from x on up to end, the last one in part: any drops, any offset of the neighbours.
  HWY_ATTR void single(std::span<const Drop> drops, int x, int end, int y) const {
    constexpr int n = Lanes::size();
    Storage* out = job_.previous->row<Storage>(y);
    const WaveRows<const Storage*, Storage> rows = rows_around<Storage>(
        u_, corrected, [&](int dy) HWY_ATTR { return newest(y + dy); }, out, shore(y));
    for (; x < end; x += n) {
      if constexpr (corrected)
        store(out + x, wave_step_corrected<Lanes>(u_, rows, drops, x, y), rounding, std::min(n, end - x));
      else
        store(out + x, wave_step_as_published<Lanes>(u_, rows, drops, x, y), rounding, std::min(n, end - x));
    }
  }
  // Columns that no drop reaches, of R rows; begin is a multiple of a vector's length.
  template <int R>
  HWY_ATTR void block(int begin, int end, int y) const {
    if (corrected || u_.step == 1.0f) {
      std::array<const Storage*, R + 2> rows;
      std::array<Storage*, R> out;
      std::array<const float*, R> shores;
      for (int k = 0; k < R + 2; ++k) rows[k] = newest(y + k - 1);
      for (int k = 0; k < R; ++k) out[k] = job_.previous->row<Storage>(y + k), shores[k] = shore(y + k);
      begin = step_block<R, corrected, edges, rounding, Storage>(u_, rows, out, shores, begin, end, y);
    }
    if (begin == end) return;
    for (int k = 0; k < R; ++k) single({}, begin, end, y + k);
  }
  // R rows from y on; drops: all that reach into them.
  template <int R>
  HWY_ATTR void visit(std::span<const Drop> drops, int y) const {
    const int n = Lanes::size(), width = job_.newest->width();
    for_drops(
        drops, 0, width, [&](int begin, int end) HWY_ATTR { block<R>(begin, end, y); },
        [&](int x, std::span<const Drop> near) HWY_ATTR {
          for (int k = 0; k < R; ++k) single(near, x, std::min(x + n, width), y + k);
        });
  }

 private:
  const Storage* newest(int y) const { return pass::row_at<Storage>(*job_.newest, *job_.rest_row, address_of(job_.boundary), y); }
  const float* shore(int y) const { return job_.shore ? job_.shore->row<float>(y) : nullptr; }
  const WaveJob& job_;
  WaveStepUniforms u_;
};
template <bool corrected, Edges edges, Rounding rounding, class Storage>
HWY_ATTR void step_rows(const WaveJob& job, const parallel::Tile& tile) {
  constexpr int most = Lanes::size() == 16 ? 4 : 2;  // by the number of registers
  const Rows<corrected, edges, rounding, Storage> rows(job);
  std::vector<Drop> in_tile, in_rows;
  drops_in_rows(job.drops, tile.y0, tile.y1, in_tile);
  for (int y = tile.y0; y < tile.y1;) {
    const int left = tile.y1 - y, count = left >= most ? most : left >= 2 ? 2 : 1;
    if (!in_tile.empty()) drops_in_rows(in_tile, y, y + count, in_rows);
    if (count == most)
      rows.template visit<most>(in_rows, y);
    else
      count == 2 ? rows.template visit<2>(in_rows, y) : rows.template visit<1>(in_rows, y);
    y += count;
  }
  for (int y = tile.y0; y < tile.y1; ++y)
    pass::fill_margins(job.previous->row<Storage>(y), job.newest->width(), address_of(job.boundary), *job.rest_row->row<Storage>(0));
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
  const Edges edges = !job.corrected ? Edges::none : job.uniforms.rim_damping > 0.0f ? Edges::rim : job.shore ? Edges::shore : Edges::none;
  pass::in_storage(job.newest->format(), [&]<class Storage>(Storage) HWY_ATTR {
    with_constants(job, [&](auto corrected, auto rounding) HWY_ATTR {
      if (edges == Edges::none) return step_rows<corrected(), Edges::none, rounding(), Storage>(job, tile);
      if constexpr (corrected()) {
        if (edges == Edges::shore) return step_rows<true, Edges::shore, rounding(), Storage>(job, tile);
        step_rows<true, Edges::rim, rounding(), Storage>(job, tile);
      }
    });
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
