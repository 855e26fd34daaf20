// The walk through a heightfield for several rays side by side; compiled once for each SIMD target.
#include <algorithm>

#include "compositor/heightfield_view.h"

#define RAINREF_KERNELS "compositor/kernels_heightfield.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

using LaneMask = Real64Lanes::Mask;
HWY_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE LaneMask operator^(LaneMask a, LaneMask b) { return {hn::Xor(a.m, b.m)}; }
HWY_INLINE LaneMask operator!(LaneMask a) { return {hn::Not(a.m)}; }

HWY_INLINE Real64Lanes minimum(Real64Lanes a, Real64Lanes b) { return select(b < a, b, a); }
HWY_INLINE Real64Lanes maximum(Real64Lanes a, Real64Lanes b) { return select(a < b, b, a); }
/// + 0 makes the zero positive: targets disagree on the sign of floor(-0).
HWY_INLINE Real64Lanes whole(Real64Lanes a) { return hn::Add(hn::Floor(a.v), hn::Zero(Real64Lanes::D())); }
HWY_INLINE Real64Lanes gather(const float* p, Real64Lanes index) {
  const hn::Rebind<std::int32_t, Real64Lanes::D> di;
  return widen(hn::GatherIndex(NarrowTag(), p, hn::DemoteTo(di, index.v)));
}

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "compositor/heightfield_walk-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

void MeetTile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet) {
  using R = Real64Lanes;
  const R::D d;
  constexpr int n = static_cast<int>(hn::MaxLanes(R::D()));
  constexpr int width = n < Packet::slots ? n : Packet::slots;
  for (int slot = 0; slot < Packet::slots; slot += width) {
    const std::uint32_t here = lanes >> slot & ((1u << width) - 1);
    if (here == 0) continue;
    HWY_ALIGN double limit[n] = {}, set[n] = {}, t[n], part[n], u[n], v[n], hits[n];
    for_each_lane(here, [&](std::uint32_t k) {
      set[k] = 1;
      limit[k] = packet.first[slot + static_cast<int>(k)].t;
    });
    const auto at = [&](const double* p) HWY_ATTR { return R(hn::LoadU(d, p + slot)); };
    const R origin[3] = {at(packet.origin[0]), at(packet.origin[1]), at(packet.origin[2])};
    const R direction[3] = {at(packet.direction[0]), at(packet.direction[1]), at(packet.direction[2])};
    const GridRay<R> ray = to_grid(field, origin, direction, at(packet.nearest), at(packet.farthest));
    R hit_t(0.0), hit_part(0.0), hit_u(0.0), hit_v(0.0);
    const LaneMask hit = meet_cells(field, tile, ray, R(hn::Load(d, limit)), R(hn::Load(d, set)) > R(0.0), hit_t, hit_part, hit_u, hit_v);
    if (!R::any(hit)) continue;
    hn::Store(hit_t.v, d, t);
    hn::Store(hit_part.v, d, part);
    hn::Store(hit_u.v, d, u);
    hn::Store(hit_v.v, d, v);
    hn::Store(select(hit, R(1.0), R(0.0)).v, d, hits);
    for_each_lane(here, [&](std::uint32_t k) {
      if (hits[k] == 0) return;
      const Hit found{t[k], self, static_cast<std::uint32_t>(part[k]), u[k], v[k]};
      Hit& first = packet.first[slot + static_cast<int>(k)];
      if (precedes(found, first)) first = found;
    });
  }
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

void meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet) {
  RAINREF_DISPATCH(MeetTile)(field, tile, self, lanes, packet);
}
void summarize_tile(const float* heights, int columns, float* highest, HeightfieldTile& tile) {
  RAINREF_DISPATCH(SummarizeTile)(heights, columns, highest, tile);
}

}  // namespace rainref::compositor
#endif
