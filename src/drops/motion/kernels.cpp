// Shells of integrate and merge; compiled once for each SIMD target.
#include "drops/motion/kernels.h"

#include <algorithm>

#define RAINREF_KERNELS "drops/motion/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lane_pair-inl.h"
#include "math/lanes-inl.h"
#include "pass/records-inl.h"

RAINREF_TARGET_BEGIN(drops)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "math/cube_root_lanes-inl.h"
#include "drops/drop-inl.h"
#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge.pass.h"
#undef RAINREF_FN

HWY_INLINE DropState<Lanes> load_drops(const Slots& s, std::int64_t i) {
  DropState<Lanes> d;
  d.u = Lanes::load(s.u + i);
  d.v = Lanes::load(s.v + i);
  d.velocity_u = Lanes::load(s.velocity_u + i);
  d.velocity_v = Lanes::load(s.velocity_v + i);
  d.mass = Lanes::load(s.mass + i);
  d.life = Lanes::load(s.life + i);
  return d;
}
HWY_INLINE int lanes_left(std::int64_t i, std::int64_t end) { return static_cast<int>(std::min<std::int64_t>(Lanes::size(), end - i)); }

// The numbers of the first `count` lanes, one by one.
template <class Body>
HWY_INLINE void for_lanes(Lanes x, int count, Body body) {
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(x.v, Lanes::D(), lanes);
  for (int k = 0; k < count; ++k) body(k, lanes[k]);
}
HWY_INLINE std::int64_t whole_sum(Lanes x, int count) {
  if (!any(x > Lanes(0.0f))) return 0;
  std::int64_t sum = 0;
  for_lanes(x, count, [&](int, float one) { sum += static_cast<std::int64_t>(one); });
  return sum;
}
HWY_INLINE std::int64_t whole_sum(const LanePair& x, int count) {
  if (!any(x > LanePair(0.0f))) return 0;
  constexpr int n = Lanes::size();
  return whole_sum(x.a, std::min(count, n)) + whole_sum(x.b, std::max(count - n, 0));
}

MassBalance IntegrateRange(const IntegrateUniforms& uniforms, bool corrected, const pass::HostIo<IntegratePass>& io, std::int64_t begin,
                           std::int64_t end) {
  MassBalance balance;
  const std::vector<float*>& columns = io.drops.columns;
  if (corrected) {
    change_records<IntegratePass, IntegratePassText, true, LanePair>(
        uniforms, io, columns, begin, end,
        [&](std::int64_t, int count, const DropState<LanePair>&, const Integrated<LanePair>& after) HWY_ATTR {
          balance.evaporated += whole_sum(after.evaporated, count);
          balance.removed += whole_sum(after.removed, count);
        });
  } else {
    change_records<IntegratePass, IntegratePassText, false>(
        uniforms, io, columns, begin, end,
        [&](std::int64_t, int count, const DropState<Lanes>& before, const DropState<Lanes>& after)
            HWY_ATTR { balance.removed += whole_sum(select(before.lives() & !after.lives(), Lanes(1.0f), Lanes(0.0f)), count); });
  }
  return balance;
}

void Measure(const MergeUniforms& uniforms, const Slots& s, std::int64_t begin, std::int64_t end, float* x, float* y, float* radius) {
  for (std::int64_t i = begin; i < end; i += Lanes::size()) {
    const int count = lanes_left(i, end);
    const Lanes u = Lanes::load(s.u + i), v = Lanes::load(s.v + i);
    store(x + i, plane_x(uniforms, u, v), Rounding::rne, count);
    store(y + i, plane_y(uniforms, v), Rounding::rne, count);
    store(radius + i, base_radius(uniforms, Lanes::load(s.mass + i)), Rounding::rne, count);
  }
}

// The largest of the sorted drops [from, to) that touches drop i and is larger than `best`, else `best`.
HWY_INLINE std::int32_t largest_touching(const MergeGrid& g, std::size_t i, std::uint32_t from, std::uint32_t to, std::int32_t best) {
  const Lanes x(g.x[i]), y(g.y[i]), radius(g.radius[i]), zero(0.0f), one(1.0f);
  for (std::uint32_t k = from; k < to; k += static_cast<std::uint32_t>(Lanes::size())) {
    const auto touching = touches(x, y, radius, Lanes::load(g.x.data() + k), Lanes::load(g.y.data() + k), Lanes::load(g.radius.data() + k));
    if (!any(touching)) continue;
    for_lanes(select(touching, one, zero), lanes_left(k, to), [&](int lane, float hit) {
      const std::size_t j = k + static_cast<std::uint32_t>(lane), b = best < 0 ? i : static_cast<std::size_t>(best);
      if (hit > 0 && (g.mass[j] > g.mass[b] || (g.mass[j] == g.mass[b] && g.id[j] < g.id[b]))) best = static_cast<std::int32_t>(j);
    });
  }
  return best;
}
void FindLarger(const MergeGrid& g, std::int64_t begin, std::int64_t end, std::int32_t* larger) {
  for (std::int64_t k = begin; k < end; ++k) {
    const auto i = static_cast<std::size_t>(k);
    std::int32_t best = -1;
    // A larger drop is of the same class or a higher one.
    for (int c = size_class_of(g.mass[i]); c < size_classes; ++c) {
      const ClassGrid& grid = g.classes[static_cast<std::size_t>(c)];
      if (grid.columns == 0) continue;
      const int column = grid.column(g.x[i]), row = grid.row(g.y[i]);
      const int left = std::max(0, column - 1), right = std::min(grid.columns - 1, column + 1);
      for (int y = std::max(0, row - 1); y <= std::min(grid.rows - 1, row + 1); ++y) {
        const std::uint32_t first = grid.first_cell + static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(grid.columns);
        best = largest_touching(g, i, g.cell_start[first + static_cast<std::uint32_t>(left)],
                                g.cell_start[first + static_cast<std::uint32_t>(right) + 1], best);
      }
    }
    larger[i] = best;
  }
}

void Trails(const MergeUniforms& uniforms, const Slots& s, std::int64_t begin, std::int64_t end, std::vector<Deposit>& deposits) {
  const Lanes zero(0.0f);
  const auto columns = Lanes::uniform_int(uniforms.film[0]), rows = Lanes::uniform_int(uniforms.film[1]);
  for (std::int64_t i = begin; i < end; i += Lanes::size()) {
    const int count = lanes_left(i, end);
    const DropState<Lanes> d = load_drops(s, i);
    const Trail<Lanes> t = trail(uniforms, d);
    const auto some = t.mass_units > zero;
    if (!any(some)) continue;
    store(s.mass + i, d.mass - t.mass_units, Rounding::rne, count);
    const Lanes u = select(some, t.u, zero), v = select(some, t.v, zero);
    HWY_ALIGN float column[HWY_MAX_BYTES / sizeof(float)], row[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(to_number(clamp_index(to_int(u * to_number(columns)), columns)).v, Lanes::D(), column);
    hn::Store(to_number(clamp_index(to_int(v * to_number(rows)), rows)).v, Lanes::D(), row);
    for_lanes(t.mass_units, count, [&](int k, float mass_units) {
      if (mass_units > 0) deposits.push_back({static_cast<std::int32_t>(column[k]), static_cast<std::int32_t>(row[k]), mass_units});
    });
  }
}

std::int64_t DryRow(const MergeUniforms& uniforms, float* row, int width) {
  std::int64_t lost = 0;
  for (int x = 0; x < width; x += Lanes::size()) {
    const int count = std::min(Lanes::size(), width - x);
    const Lanes before = Lanes::load(row + x);
    if (!any(before > Lanes(0.0f))) continue;
    const Lanes after = dried(uniforms, before);
    store(row + x, after, Rounding::rne, count);
    lost += whole_sum(before - after, count);
  }
  return lost;
}
RAINREF_TARGET_END(drops)

#if RAINREF_ONCE
namespace rainref::drops {

RAINREF_EXPORT(IntegrateRange);
RAINREF_EXPORT(Measure);
RAINREF_EXPORT(FindLarger);
RAINREF_EXPORT(Trails);
RAINREF_EXPORT(DryRow);

MassBalance integrate_range(const IntegrateUniforms& uniforms, bool corrected, const pass::HostIo<IntegratePass>& io, std::int64_t begin,
                            std::int64_t end) {
  return RAINREF_DISPATCH(IntegrateRange)(uniforms, corrected, io, begin, end);
}
void measure_range(const MergeUniforms& uniforms, const Slots& slots, std::int64_t begin, std::int64_t end, float* x, float* y,
                   float* radius) {
  RAINREF_DISPATCH(Measure)(uniforms, slots, begin, end, x, y, radius);
}
void find_larger_range(const MergeGrid& grid, std::int64_t begin, std::int64_t end, std::int32_t* larger) {
  RAINREF_DISPATCH(FindLarger)(grid, begin, end, larger);
}
void trail_range(const MergeUniforms& uniforms, const Slots& slots, std::int64_t begin, std::int64_t end, std::vector<Deposit>& deposits) {
  RAINREF_DISPATCH(Trails)(uniforms, slots, begin, end, deposits);
}
std::int64_t dry_row(const MergeUniforms& uniforms, float* row, int width) { return RAINREF_DISPATCH(DryRow)(uniforms, row, width); }

}  // namespace rainref::drops
#endif
