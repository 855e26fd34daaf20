// The walk through a heightfield for several rays side by side; compiled once for each SIMD target.
#include <algorithm>

#include "compositor/heightfield_view.h"

#define RAINREF_KERNELS "compositor/kernels_heightfield.cpp"
#include "math/foreach_target.h"
#include "compositor/packet_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

/// + 0 makes the zero positive, because targets differ in the sign of floor(-0).
HWY_INLINE Real64Lanes whole(Real64Lanes a) { return hn::Add(hn::Floor(a.v), hn::Zero(Real64Lanes::D())); }
HWY_INLINE Real64Lanes gather(const float* p, Real64Lanes index) {
  const hn::Rebind<std::int32_t, Real64Lanes::D> di;
  return widen(hn::GatherIndex(NarrowTag(), p, hn::DemoteTo(di, index.v)));
}

// Two vectors side by side: a step of the walk is one chain of dependent operations, and two chains keep the processor busy.
using Pair = Real64Pair<Real64Lanes>;
HWY_INLINE Pair::Mask operator&(const Pair::Mask& a, const Pair::Mask& b) { return {a.lower & b.lower, a.upper & b.upper}; }
HWY_INLINE Pair::Mask operator|(const Pair::Mask& a, const Pair::Mask& b) { return {a.lower | b.lower, a.upper | b.upper}; }
HWY_INLINE Pair::Mask operator^(const Pair::Mask& a, const Pair::Mask& b) { return {a.lower ^ b.lower, a.upper ^ b.upper}; }
HWY_INLINE Pair::Mask without(const Pair::Mask& a, const Pair::Mask& b) { return {without(a.lower, b.lower), without(a.upper, b.upper)}; }
HWY_INLINE Pair minimum(const Pair& a, const Pair& b) { return {minimum(a.lower, b.lower), minimum(a.upper, b.upper)}; }
HWY_INLINE Pair maximum(const Pair& a, const Pair& b) { return {maximum(a.lower, b.lower), maximum(a.upper, b.upper)}; }
HWY_INLINE Pair whole(const Pair& a) { return {whole(a.lower), whole(a.upper)}; }
HWY_INLINE Pair gather(const float* p, const Pair& index) { return {gather(p, index.lower), gather(p, index.upper)}; }

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE HWY_ATTR void corners(const float* pairs, const Pair& index, Pair& h00, Pair& h10, Pair& h01, Pair& h11) {
  const Pair first = index * Pair(2.0);
  h00 = gather(pairs, first), h01 = gather(pairs + 1, first), h10 = gather(pairs + 2, first), h11 = gather(pairs + 3, first);
}
#else
using FloatLanes = hn::Vec<FloatTag>;

/// Four floats from 2 at[0], four from 2 at[4] and so on.
template <class D>
HWY_INLINE HWY_ATTR hn::Vec<D> every_fourth(D d, const float* p, const std::uint32_t* at) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(d, p + 2 * static_cast<std::size_t>(at[0]));
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, every_fourth(half, p, at + hn::MaxLanes(half)), every_fourth(half, p, at));
  }
}
/// The corners of cells, four in a row: one load per lane, then blocks of vectors transposed.
HWY_INLINE HWY_ATTR void corners(const float* pairs, hn::Vec<hn::RebindToSigned<FloatTag> > index, FloatLanes& h00, FloatLanes& h10,
                                 FloatLanes& h01, FloatLanes& h11) {
  const FloatTag d;
  const hn::RebindToUnsigned<FloatTag> du;
  HWY_ALIGN std::uint32_t at[hn::MaxLanes(d)];
  hn::Store(hn::BitCast(du, index), du, at);
  const auto r0 = every_fourth(d, pairs, at), r1 = every_fourth(d, pairs, at + 1), r2 = every_fourth(d, pairs, at + 2),
             r3 = every_fourth(d, pairs, at + 3);
  const hn::RepartitionToWide<FloatTag> w;
  const auto a01 = hn::BitCast(w, hn::InterleaveLower(d, r0, r1)), a23 = hn::BitCast(w, hn::InterleaveLower(d, r2, r3));
  const auto b01 = hn::BitCast(w, hn::InterleaveUpper(d, r0, r1)), b23 = hn::BitCast(w, hn::InterleaveUpper(d, r2, r3));
  h00 = hn::BitCast(d, hn::InterleaveLower(w, a01, a23));
  h01 = hn::BitCast(d, hn::InterleaveUpper(w, a01, a23));
  h10 = hn::BitCast(d, hn::InterleaveLower(w, b01, b23));
  h11 = hn::BitCast(d, hn::InterleaveUpper(w, b01, b23));
}
HWY_INLINE HWY_ATTR void corners(const float* pairs, const Pair& index, Pair& h00, Pair& h10, Pair& h01, Pair& h11) {
  const hn::Rebind<std::int32_t, Real64Lanes::D> half;
  FloatLanes a, b, c, e;
  corners(pairs, hn::Combine(hn::RebindToSigned<FloatTag>(), hn::DemoteTo(half, index.upper.v), hn::DemoteTo(half, index.lower.v)), a, b, c,
          e);
  h00 = to_double(a), h10 = to_double(b), h01 = to_double(c), h11 = to_double(e);
}
#endif

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "compositor/heightfield_walk-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

HWY_INLINE HWY_ATTR Pair load_pair(const double* p) { return {load_slots(p), load_slots(p + lane_width)}; }

template <bool is_level>
HWY_INLINE HWY_ATTR GridRay<Pair> load_ray(const HeightfieldView& field, const Packet& packet, int slot) {
  const auto load = [slot](const double* p) HWY_ATTR { return load_pair(p + slot); };
  const Pair origin[3] = {load(packet.origin[0]), load(packet.origin[1]), load(packet.origin[2])};
  const Pair direction[3] = {load(packet.direction[0]), load(packet.direction[1]), load(packet.direction[2])};
  return to_grid<is_level>(field, origin, direction, load(packet.nearest), load(packet.farthest));
}
HWY_INLINE HWY_ATTR Pair known_distances(const Packet& packet, int slot) { return load_pair(packet.distance + slot); }
HWY_INLINE HWY_ATTR Pair::Mask pair_mask(std::uint32_t bits) {
  return {mask_of_bits(bits & ((1u << lane_width) - 1)), mask_of_bits(bits >> lane_width)};
}
HWY_INLINE HWY_ATTR std::uint32_t take_pair_hits(const Pair::Mask& hit, const Pair& t, const Pair& part, const Pair& u, const Pair& v,
                                                 std::uint32_t self, int slot, Packet& packet) {
  return take_hits(hit.lower, t.lower, part.lower, u.lower, v.lower, self, slot, packet) |
         take_hits(hit.upper, t.upper, part.upper, u.upper, v.upper, self, slot + lane_width, packet);
}

/// Not inlined, so that the float walk, which decides almost all rays, gets the registers.
HWY_NOINLINE HWY_ATTR std::uint32_t walk_in_doubles(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, int slot,
                                                    std::uint32_t lanes, Packet& packet) {
  const GridRay<Pair> ray = load_ray<false>(field, packet, slot);
  const Pair known = known_distances(packet, slot);
  Pair t(0.0), part(0.0), u(0.0), v(0.0);
  const Pair::Mask hit = meet_cells(field, tile, ray, known, pair_mask(lanes), t, part, u, v);
  return take_pair_hits(hit, t, part, u, v, self, slot, packet);
}

#if HWY_TARGET == HWY_SCALAR
template <bool is_level>
HWY_INLINE HWY_ATTR std::uint32_t walk_in_floats(const HeightfieldView&, const HeightfieldTile&, std::uint32_t, int, std::uint32_t&,
                                                 Packet&) {
  return 0;
}
#else
#include "compositor/heightfield_float_walk-inl.h"

/// Decides the `lanes` that floats can decide, and removes them.
template <bool is_level>
HWY_INLINE HWY_ATTR std::uint32_t walk_in_floats(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, int slot,
                                                 std::uint32_t& lanes, Packet& packet) {
  using R = Pair;
  const GridRay<R> ray = load_ray<is_level>(field, packet, slot);
  const R known = known_distances(packet, slot);
  float_walk::Outcome outcome;
  float_walk::walk(field, tile, ray, known, lanes, outcome);
  lanes &= ~outcome.missed;
  if (outcome.guessed == 0) return 0;
  const R one(1.0), zero(0.0), i = to_double(outcome.i) + R(tile.x0), j = to_double(outcome.j) + R(tile.y0);
  const R::Mask is_upper = pair_mask(outcome.upper);
  const R upper = select(is_upper, one, zero);
  R closing(0.0);
  const R t = zero + meet_plane(ray, i, j, upper, is_upper, to_double(outcome.h00), to_double(outcome.h10), to_double(outcome.h01),
                                to_double(outcome.h11), closing);
  const R u = within_unit(ray.ox + t * ray.dx - i), v = within_unit(ray.oy + t * ray.dy - j);
  const R part = (j * R(field.columns) + i) * R(2.0) + upper;
  // Far enough inside the triangle that at its edges the ray's distance from the plane exceeds the roundings of the walk in doubles.
  const R w = select(is_upper, one - u, u), z = select(is_upper, one - v, v), inner = minimum(minimum(w, z), one - (w + z));
  const R::Mask inside = (inner > R(0x1p-24)) & (inner * abs(closing) > (abs(ray.dx) + abs(ray.dy)) * R(tile.roundings)) &
                         (t > ray.nearest) & pair_mask(outcome.guessed);
  lanes &= ~(bits_of(inside.lower) | bits_of(inside.upper) << lane_width);
  return take_pair_hits(inside & (t <= minimum(ray.farthest, known)), t, part, u, v, self, slot, packet);
}
#endif

template <bool is_level>
HWY_INLINE HWY_ATTR std::uint32_t meet_slots(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self,
                                             std::uint32_t lanes, Packet& packet) {
  constexpr int width = 2 * lane_width;
  static_assert(Packet::slots % width == 0);
  std::uint32_t changed = 0;
  for (int slot = 0; slot < Packet::slots; slot += width) {
    std::uint32_t here = lanes >> slot & ((1u << width) - 1);
    if (here == 0) continue;
    changed |= walk_in_floats<is_level>(field, tile, self, slot, here, packet);
    if (here != 0) changed |= walk_in_doubles(field, tile, self, slot, here, packet);
  }
  return changed;
}

std::uint32_t MeetTile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet) {
  return field.is_level ? meet_slots<true>(field, tile, self, lanes, packet) : meet_slots<false>(field, tile, self, lanes, packet);
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(MeetTile);

std::uint32_t meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes,
                        Packet& packet) {
  return RAINREF_DISPATCH(MeetTile)(field, tile, self, lanes, packet);
}

}  // namespace rainref::compositor
#endif
