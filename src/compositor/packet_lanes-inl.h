// What kernels over packets share: masks, the slots of a packet in vectors, hits given back. Re-included for every target.
#if defined(RAINREF_COMPOSITOR_PACKET_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
#undef RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
#else
#define RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
#endif

#include "compositor/packet.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

using LaneMask = Real64Lanes::Mask;
HWY_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE LaneMask operator^(LaneMask a, LaneMask b) { return {hn::Xor(a.m, b.m)}; }
/// a and not b.
HWY_INLINE LaneMask without(LaneMask a, LaneMask b) { return {hn::AndNot(b.m, a.m)}; }

// b < a ? b : a and a < b ? b : a, which MINPD and MAXPD compute exactly, signed zeros included; see Lanes.
#if HWY_TARGET <= HWY_SSSE3 && HWY_ARCH_X86
HWY_INLINE Real64Lanes minimum(Real64Lanes a, Real64Lanes b) { return hn::Min(b.v, a.v); }
HWY_INLINE Real64Lanes maximum(Real64Lanes a, Real64Lanes b) { return hn::Max(b.v, a.v); }
#else
HWY_INLINE Real64Lanes minimum(Real64Lanes a, Real64Lanes b) { return select(b < a, b, a); }
HWY_INLINE Real64Lanes maximum(Real64Lanes a, Real64Lanes b) { return select(a < b, b, a); }
#endif

constexpr int lane_width = static_cast<int>(hn::MaxLanes(Real64Lanes::D()));
static_assert(Packet::slots % lane_width == 0 && lane_width <= 8);

HWY_INLINE HWY_ATTR Real64Lanes load_slots(const double* p) { return hn::LoadU(Real64Lanes::D(), p); }
HWY_INLINE HWY_ATTR LaneMask mask_of_bits(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
  return {hn::LoadMaskBits(Real64Lanes::D(), bytes)};
}
HWY_INLINE HWY_ATTR std::uint32_t bits_of(LaneMask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Real64Lanes::D(), mask.m, bytes);
  return bytes[0];
}
/// The distances of hits[0] and the next ones.
HWY_INLINE HWY_ATTR Real64Lanes distances(const Hit* hits) {
  static_assert(sizeof(Hit) == 4 * sizeof(double));
  return hn::GatherIndex(Real64Lanes::D(), &hits[0].t, hn::ShiftLeft<2>(hn::Iota(hn::RebindToSigned<Real64Lanes::D>(), 0)));
}

/// Hits of the lanes in `hit`, for the slots from `slot` on: puts those first that precede what is there, and gives their
/// slots. `known` are the distances of what is there, part(lane) is the part that was met.
template <class Part>
HWY_INLINE HWY_ATTR std::uint32_t take_hits(LaneMask hit, Real64Lanes known, Real64Lanes hit_t, Real64Lanes hit_u, Real64Lanes hit_v, std::uint32_t self, int slot, const Part& part, Packet& packet) {
  if (!Real64Lanes::any(hit)) return 0;
  HWY_ALIGN double t[lane_width], u[lane_width], v[lane_width];
  hn::Store(hit_t.v, Real64Lanes::D(), t);
  hn::Store(hit_u.v, Real64Lanes::D(), u);
  hn::Store(hit_v.v, Real64Lanes::D(), v);
  const LaneMask is_nearer = hit & (hit_t < known);
  std::uint32_t nearer = bits_of(is_nearer);
  for (std::uint32_t equal = bits_of(without(hit & (hit_t <= known), is_nearer)); equal != 0; equal &= equal - 1) {
    const auto k = static_cast<std::uint32_t>(__builtin_ctz(equal));
    if (precedes(Hit{t[k], self, part(k), u[k], v[k]}, packet.first[slot + static_cast<int>(k)])) nearer |= 1u << k;
  }
  for (std::uint32_t left = nearer; left != 0; left &= left - 1) {
    const auto k = static_cast<std::uint32_t>(__builtin_ctz(left));
    packet.first[slot + static_cast<int>(k)] = Hit{t[k], self, part(k), u[k], v[k]};
  }
  return nearer << slot;
}

RAINREF_TARGET_END(compositor)

#endif  // RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
