// Shell of wave_step; compiled once for each SIMD target.
#include <algorithm>
#include <array>
#include <type_traits>
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
/// The drops that reach into columns [x0, x1], in order. Not std::views::filter, with which GCC makes a slower loop of step_block.
class DropsInColumns {
 public:
  DropsInColumns(std::span<const Drop> drops, int x0, int x1) : drops_(drops), x0_(static_cast<float>(x0)), x1_(static_cast<float>(x1)) {}
  class Iterator {
   public:
    Iterator(const DropsInColumns& range, const Drop* at) : range_(range), at_(at) { skip(); }
    const Drop& operator*() const { return *at_; }
    bool operator!=(const Drop* end) const { return at_ != end; }
    Iterator& operator++() {
      ++at_;
      skip();
      return *this;
    }

   private:
    void skip() {
      while (at_ != range_.end() && !(at_->x + at_->radius >= range_.x0_ && at_->x - at_->radius <= range_.x1_)) ++at_;
    }
    const DropsInColumns& range_;
    const Drop* at_;
  };
  Iterator begin() const { return Iterator(*this, drops_.data()); }
  const Drop* end() const { return drops_.data() + drops_.size(); }
  bool empty() const { return drops_.empty(); }

 private:
  std::span<const Drop> drops_;
  float x0_, x1_;
};
/// The first vector from column x on that a drop of the row may reach; end if there is none. x is a multiple of a vector's length.
HWY_INLINE HWY_ATTR int next_vector(std::span<const Drop> in_row, int x, int end) {
  const int n = Lanes::size();
  int next = end;
  for (const Drop& d : in_row) {
    if (d.x + d.radius < static_cast<float>(x)) continue;
    const float first = d.x - d.radius - 1.0f;
    if (first >= static_cast<float>(next)) continue;
    next = first <= static_cast<float>(x) ? x : static_cast<int>(first) / n * n;
  }
  return next;
}

// ---- rows at a time --------------------------------------------------------------------------------------------------
// A vector of a row and its neighbours, in registers. An unaligned load takes as long as two, and may have to wait for a store with the
// same offset in another page.
struct LoadedRow {
  Lanes left, here, right;
  int x;
};
template <class N>
HWY_INLINE HWY_ATTR N element(const LoadedRow& row, int x) {
  return x == row.x ? row.here : x < row.x ? row.left : row.right;  // known at compile time
}
// Inputs of a step of the corrected pass besides the two levels. Compile-time constants, because each costs much of the time of a step.
enum class Edges { none, shore, rim };

// Without it the compiler calls some of these functions, and their references live in memory.
#undef RAINREF_INLINED
#define RAINREF_INLINED HWY_ATTR __attribute__((always_inline))

template <int... Rows, class F>
HWY_INLINE HWY_ATTR void for_each_row(std::integer_sequence<int, Rows...>, const F& f) {
  (f(std::integral_constant<int, Rows>()), ...);
}
// Start of the rows of both levels that a later call reads; with every vector a cache line of each is fetched. The fetches are spread among
// the other instructions, because a core can wait for only a few lines at once.
using Fetched = std::array<const std::byte*, 2>;
constexpr int line = 64;  // bytes of a cache line
// Whole vectors of columns [0, end) in R rows from y on, which `drops` reach; each vector of the newest level is loaded once. Returns the
// first remaining column. Neighbours are one texel away.
template <int R, bool corrected, Edges edges, Rounding rounding, class Storage>
HWY_NOINLINE HWY_ATTR int step_block(WaveStepUniforms u, std::array<const Storage*, R + 2> newest, std::array<Storage*, R> out,
                                     std::array<const float*, R> shore, std::span<const Drop> drops, Fetched fetched, int end, int y) {
  constexpr int n = Lanes::size();
  constexpr std::integer_sequence each = std::make_integer_sequence<int, R>();
  constexpr std::span<const Drop> none;
  if (edges != Edges::rim) u.rim_damping = 0.0f;
  Lanes before[R], here[R], after[R], next[R];
  for_each_row(each, [&](auto k) RAINREF_INLINED {
    before[k] = Lanes::load(newest[k + 1] - n);
    here[k] = Lanes::load(newest[k + 1]);
  });
  const auto vector_of_rows = [&](const auto& near, int x) RAINREF_INLINED {
    for (const std::byte* rows : fetched) __builtin_prefetch(rows + x * (line / n), 0, 2);  // into the second cache
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
        next[k] = wave_step_corrected<Lanes>(u, rows, near, x, y + k);
      else
        next[k] = wave_step_as_published<Lanes>(u, rows, near, x, y + k);
    });
    for_each_row(each, [&](auto k) RAINREF_INLINED {
      // No stored value is -0, so a sum that begins with a stored value, or with 1/2, is not -0 either.
      store_without_minus_zero(out[k] + x, next[k], rounding);
      before[k] = here[k];
      here[k] = after[k];
    });
  };
  int x = 0;
  for (;;) {
    const int stop = std::min(next_vector(drops, x, end), end / n * n);
    for (; x < stop; x += n) vector_of_rows(none, x);
    if (x + n > end) return x;
    vector_of_rows(DropsInColumns(drops, x, x + n), x);
    x += n;
  }
}

// ---- steps -----------------------------------------------------------------------------------------------------------
template <bool corrected, Edges edges, Rounding rounding, class Storage>
class Rows {
 public:
  explicit Rows(const WaveJob& job) : job_(job), u_(job.uniforms) {}
  // R rows from y on; drops: all that reach them. Removes the rows that it fetches from the rows ahead.
  template <int R>
  HWY_ATTR void visit(std::span<const Drop> drops, int y, RowsAhead& ahead) const {
    const int width = job_.newest->width();
    int x = 0;
    if (corrected || u_.step == 1.0f) {
      std::array<const Storage*, R + 2> rows;
      std::array<Storage*, R> out;
      std::array<const float*, R> shores;
      for (int k = 0; k < R + 2; ++k) rows[k] = newest(y + k - 1);
      for (int k = 0; k < R; ++k) out[k] = job_.previous->row<Storage>(y + k), shores[k] = shore(y + k);
      int next = y;  // rows that are cached: fetching them again costs less than a branch
      if (ahead.y0 < ahead.y1) {
        next = ahead.y0;
        ahead.y0 = std::min(ahead.y0 + rows_fetched, ahead.y1);
      }
      const Fetched fetched{job_.newest->row_bytes(next), job_.previous->row_bytes(next)};
      x = step_block<R, corrected, edges, rounding, Storage>(u_, rows, out, shores, drops, fetched, width, y);
    }
    if (x == width) return;
    for (int k = 0; k < R; ++k) single(drops, x, y + k);
  }

  // Vectors from x on, the last one in part, with any offset of the neighbours.
  HWY_ATTR void single(std::span<const Drop> drops, int x, int y) const {
    const int n = Lanes::size(), width = job_.newest->width();
    Storage* out = job_.previous->row<Storage>(y);
    const WaveRows<const Storage*, Storage> rows = rows_around<Storage>(
        u_, corrected, [&](int dy) HWY_ATTR { return newest(y + dy); }, out, shore(y));
    for (; x < width; x += n) {
      const DropsInColumns near(drops, x, x + n);
      if constexpr (corrected)
        store(out + x, wave_step_corrected<Lanes>(u_, rows, near, x, y), rounding, std::min(n, width - x));
      else
        store(out + x, wave_step_as_published<Lanes>(u_, rows, near, x, y), rounding, std::min(n, width - x));
    }
  }

 private:
  // Rows prefetched per computed row, with one line per vector; rows are contiguous in memory.
  static constexpr int rows_fetched = std::max(line / (Lanes::size() * static_cast<int>(sizeof(Storage))), 1);
  const Storage* newest(int y) const { return pass::row_at<Storage>(*job_.newest, *job_.rest_row, address_of(job_.boundary), y); }
  const float* shore(int y) const { return job_.shore ? job_.shore->row<float>(y) : nullptr; }
  const WaveJob& job_;
  WaveStepUniforms u_;
};
template <bool corrected, Edges edges, Rounding rounding, class Storage>
HWY_ATTR void step_rows(const WaveJob& job, const parallel::Tile& tile, RowsAhead& ahead) {
  constexpr int most = Lanes::size() == 16 ? 4 : 2;  // limited by the number of registers
  const Rows<corrected, edges, rounding, Storage> rows(job);
  std::vector<Drop> in_tile, in_rows;
  drops_in_rows(job.drops, tile.y0, tile.y1, in_tile);
  int y = tile.y0;
  for (; y + most <= tile.y1; y += most) {
    if (!in_tile.empty()) drops_in_rows(in_tile, y, y + most, in_rows);
    rows.template visit<most>(in_rows, y, ahead);
  }
  for (; y < tile.y1; ++y) {  // few: the last rows of a plane, or at the end of a band
    drops_in_rows(in_tile, y, y + 1, in_rows);
    rows.single(in_rows, 0, y);
  }
  for (y = tile.y0; y < tile.y1; ++y)
    pass::fill_margins(job.previous->row<Storage>(y), job.newest->width(), address_of(job.boundary), *job.rest_row->row<Storage>(0));
}
template <bool corrected, Edges edges, class Storage>
HWY_ATTR void step_rounded(const WaveJob& job, const parallel::Tile& tile, RowsAhead& ahead) {
  if constexpr (!std::is_same_v<Storage, float>)  // whose range contains every result
    if (job.rounding == Rounding::rtz) return step_rows<corrected, edges, Rounding::rtz, Storage>(job, tile, ahead);
  step_rows<corrected, edges, Rounding::rne, Storage>(job, tile, ahead);
}
RowsAhead StepRows(const WaveJob& job, const parallel::Tile& tile, RowsAhead ahead) {
  pass::in_storage(job.newest->format(), [&]<class Storage>(Storage) HWY_ATTR {
    if (!job.corrected) return step_rounded<false, Edges::none, Storage>(job, tile, ahead);
    if (job.uniforms.rim_damping > 0.0f) return step_rounded<true, Edges::rim, Storage>(job, tile, ahead);
    if (job.shore) return step_rounded<true, Edges::shore, Storage>(job, tile, ahead);
    step_rounded<true, Edges::none, Storage>(job, tile, ahead);
  });
  return ahead;
}

template <class Storage>
HWY_ATTR void previous_rows(const WaveJob& job, const parallel::Tile& tile) {
  const int n = Lanes::size(), width = job.newest->width();
  std::vector<Drop> in_tile, in_row;
  drops_in_rows(job.drops, tile.y0, tile.y1, in_tile);
  for (int y = tile.y0; y < tile.y1; ++y) {
    drops_in_rows(in_tile, y, y + 1, in_row);
    if (in_row.empty()) continue;
    Storage* row = job.newest->row<Storage>(y);
    const float* shore = job.shore ? job.shore->row<float>(y) : nullptr;
    for (int x = 0; (x = next_vector(in_row, x, width)) < width; x += n)
      store(row + x, wave_previous_corrected<Lanes>(row, shore, DropsInColumns(in_row, x, x + n), x, y), job.rounding,
            std::min(n, width - x));
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

RowsAhead wave_step_rows(const WaveJob& job, const parallel::Tile& tile, RowsAhead ahead) {
  return RAINREF_DISPATCH(StepRows)(job, tile, ahead);
}
void wave_previous_rows(const WaveJob& job, const parallel::Tile& tile) { RAINREF_DISPATCH(PreviousRows)(job, tile); }

}  // namespace rainref::puddle
#endif
