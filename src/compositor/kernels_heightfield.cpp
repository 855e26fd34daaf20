// The walk through a heightfield for several rays side by side; compiled once for each SIMD target.
#include <algorithm>

#include "compositor/heightfield_view.h"

#define RAINREF_KERNELS "compositor/kernels_heightfield.cpp"
#include "math/foreach_target.h"
#include "compositor/packet_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

/// + 0 makes the zero positive: targets disagree on the sign of floor(-0).
HWY_INLINE Real64Lanes whole(Real64Lanes a) { return hn::Add(hn::Floor(a.v), hn::Zero(Real64Lanes::D())); }
HWY_INLINE Real64Lanes gather(const float* p, Real64Lanes index) {
  const hn::Rebind<std::int32_t, Real64Lanes::D> di;
  return widen(hn::GatherIndex(NarrowTag(), p, hn::DemoteTo(di, index.v)));
}
/// p[i] and p[i + 1].
HWY_INLINE void gather_two(const float* p, Real64Lanes index, Real64Lanes& a, Real64Lanes& b) {
#if HWY_TARGET <= HWY_AVX2 && HWY_TARGET != HWY_SCALAR
  const hn::RebindToSigned<Real64Lanes::D> di;
  const Real64Lanes::DU du;
  const hn::Rebind<std::uint32_t, Real64Lanes::D> narrow;
  const auto offset = hn::PromoteTo(di, hn::DemoteTo(hn::Rebind<std::int32_t, Real64Lanes::D>(), (index * Real64Lanes(4.0)).v));
  const auto both = hn::BitCast(du, hn::GatherOffset(Real64Lanes::D(), reinterpret_cast<const double*>(p), offset));
  a = widen(hn::BitCast(NarrowTag(), hn::TruncateTo(narrow, both)));
  b = widen(hn::BitCast(NarrowTag(), hn::TruncateTo(narrow, hn::ShiftRight<32>(both))));
#else
  a = gather(p, index);
  b = gather(p + 1, index);
#endif
}

// Two vectors side by side: a step of the walk is one chain of dependent operations, and two of them keep the processor
// busy where one would not.
using Pair = Real64Pair<Real64Lanes>;
HWY_INLINE Pair::Mask operator&(const Pair::Mask& a, const Pair::Mask& b) { return {a.lower & b.lower, a.upper & b.upper}; }
HWY_INLINE Pair::Mask operator|(const Pair::Mask& a, const Pair::Mask& b) { return {a.lower | b.lower, a.upper | b.upper}; }
HWY_INLINE Pair::Mask operator^(const Pair::Mask& a, const Pair::Mask& b) { return {a.lower ^ b.lower, a.upper ^ b.upper}; }
HWY_INLINE Pair::Mask without(const Pair::Mask& a, const Pair::Mask& b) { return {without(a.lower, b.lower), without(a.upper, b.upper)}; }
HWY_INLINE Pair minimum(const Pair& a, const Pair& b) { return {minimum(a.lower, b.lower), minimum(a.upper, b.upper)}; }
HWY_INLINE Pair maximum(const Pair& a, const Pair& b) { return {maximum(a.lower, b.lower), maximum(a.upper, b.upper)}; }
HWY_INLINE Pair whole(const Pair& a) { return {whole(a.lower), whole(a.upper)}; }
HWY_INLINE Pair gather(const float* p, const Pair& index) { return {gather(p, index.lower), gather(p, index.upper)}; }
HWY_INLINE void gather_two(const float* p, const Pair& index, Pair& a, Pair& b) {
  gather_two(p, index.lower, a.lower, b.lower);
  gather_two(p, index.upper, a.upper, b.upper);
}

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "compositor/heightfield_walk-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

HWY_INLINE HWY_ATTR Pair load_pair(const double* p) { return {load_slots(p), load_slots(p + lane_width)}; }

std::uint32_t MeetTile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet) {
  using R = Pair;
  constexpr int width = 2 * lane_width;
  static_assert(Packet::slots % width == 0);
  std::uint32_t changed = 0;
  for (int slot = 0; slot < Packet::slots; slot += width) {
    const std::uint32_t here = lanes >> slot & ((1u << width) - 1);
    if (here == 0) continue;
    const R::Mask active{mask_of_bits(here & ((1u << lane_width) - 1)), mask_of_bits(here >> lane_width)};
    const auto load = [slot](const double* p) HWY_ATTR { return load_pair(p + slot); };
    const R origin[3] = {load(packet.origin[0]), load(packet.origin[1]), load(packet.origin[2])};
    const R direction[3] = {load(packet.direction[0]), load(packet.direction[1]), load(packet.direction[2])};
    const GridRay<R> ray = to_grid(field, origin, direction, load(packet.nearest), load(packet.farthest));
    const R known(distances(packet.first + slot), distances(packet.first + slot + lane_width));
    R t(0.0), part(0.0), u(0.0), v(0.0);
    const R::Mask hit = meet_cells(field, tile, ray, known, active, t, part, u, v);
    if (!R::any(hit)) continue;
    changed |= take_hits(hit.lower, known.lower, t.lower, part.lower, u.lower, v.lower, self, slot, packet);
    changed |= take_hits(hit.upper, known.upper, t.upper, part.upper, u.upper, v.upper, self, slot + lane_width, packet);
  }
  return changed;
}

void SummarizeTile(const float* heights, int columns, float* highest, HeightfieldTile& tile) {
  const int x0 = static_cast<int>(tile.x0), x1 = static_cast<int>(tile.x1), n = Lanes::size();
  const std::size_t stride = static_cast<std::size_t>(columns) + 1;
  Lanes low(heights[static_cast<std::size_t>(tile.y0) * stride + x0]), high = low;
  for (auto y = static_cast<std::size_t>(tile.y0); y < static_cast<std::size_t>(tile.y1); ++y) {
    const float *a = heights + y * stride, *b = a + stride;
    float* to = highest + y * static_cast<std::size_t>(columns);
    int x = x0;
    for (; x + n <= x1; x += n) {
      const Lanes h00 = Lanes::load(a + x), h10 = Lanes::load(a + x + 1), h01 = Lanes::load(b + x), h11 = Lanes::load(b + x + 1);
      const Lanes top = max(max(h00, h10), max(h01, h11));
      hn::StoreU(top.v, Lanes::D(), to + x);
      low = min(low, min(min(h00, h10), min(h01, h11)));
      high = max(high, top);
    }
    for (; x < x1; ++x) {
      const auto [least, most] = std::minmax({a[x], a[x + 1], b[x], b[x + 1]});
      to[x] = most;
      low = min(low, Lanes(least));
      high = max(high, Lanes(most));
    }
  }
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(low.v, Lanes::D(), lanes);
  tile.low = static_cast<double>(*std::min_element(lanes, lanes + n));
  hn::Store(high.v, Lanes::D(), lanes);
  tile.high = static_cast<double>(*std::max_element(lanes, lanes + n));
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(MeetTile);
RAINREF_EXPORT(SummarizeTile);

std::uint32_t meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes,
                        Packet& packet) {
  return RAINREF_DISPATCH(MeetTile)(field, tile, self, lanes, packet);
}
void summarize_tile(const float* heights, int columns, float* highest, HeightfieldTile& tile) {
  RAINREF_DISPATCH(SummarizeTile)(heights, columns, highest, tile);
}

}  // namespace rainref::compositor
#endif
