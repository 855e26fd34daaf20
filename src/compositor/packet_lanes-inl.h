// Shared parts of kernels over packets: masks, vectors of slots, and storing of hits. Re-included for every target.
#if defined(RAINREF_COMPOSITOR_PACKET_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
#undef RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
#else
#define RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
#endif

#include <bit>
#include <cstddef>
#include <cstring>

#include "compositor/packet.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

using LaneMask = Real64Lanes::Mask;
HWY_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {hn::And(a.m, b.m)}; }
HWY_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {hn::Or(a.m, b.m)}; }
HWY_INLINE LaneMask operator^(LaneMask a, LaneMask b) { return {hn::Xor(a.m, b.m)}; }
/// a and not b.
HWY_INLINE LaneMask without(LaneMask a, LaneMask b) { return {hn::AndNot(b.m, a.m)}; }

// b < a ? b : a and a < b ? b : a, which MINPD and MAXPD compute exactly, including signed zeros; see Lanes.
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
/// The same for vectors of floats, with up to 16 lanes.
HWY_INLINE HWY_ATTR hn::Mask<FloatTag> float_mask_of_bits(std::uint32_t bits) {
  static_assert(std::endian::native == std::endian::little);
  std::uint8_t bytes[8] = {};
  std::memcpy(bytes, &bits, sizeof bits);
  return hn::LoadMaskBits(FloatTag(), bytes);
}
HWY_INLINE HWY_ATTR std::uint32_t bits_of(hn::Mask<FloatTag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  std::uint16_t bits;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}
/// Hits of the lanes in `hit`, for the slots from `slot` on: stores those that precede the current first hits, and returns their slots.
/// Parts are whole numbers below 2^32.
HWY_INLINE HWY_ATTR std::uint32_t take_hits(LaneMask hit, Real64Lanes t, Real64Lanes part, Real64Lanes u, Real64Lanes v, std::uint32_t self,
                                            int slot, Packet& packet) {
  if (!Real64Lanes::any(hit)) return 0;
  const Real64Lanes::D d;
  const Real64Lanes::DU du;
  // Surface and part, as they lie in a Hit: the sum's lowest bits are those of the whole number.
  static_assert(offsetof(Hit, surface) == 8 && offsetof(Hit, part) == 12 && offsetof(Hit, u) == 16 && sizeof(Hit) == 32);
  const auto ids = hn::BitCast(d, hn::Or(hn::ShiftLeft<32>(hn::BitCast(du, (part + Real64Lanes(0x1p52)).v)), hn::Set(du, self)));
  const Real64Lanes known = load_slots(packet.distance + slot);
  const LaneMask is_nearer = hit & (t < known);
  std::uint32_t nearer = bits_of(is_nearer);
  HWY_ALIGN double rows[4 * lane_width];
  hn::StoreInterleaved4(t.v, ids, u.v, v.v, d, rows);
  for (std::uint32_t equal = bits_of(without(hit & (t <= known), is_nearer)); equal != 0; equal &= equal - 1) {
    const auto k = static_cast<std::uint32_t>(__builtin_ctz(equal));
    Hit found;
    std::memcpy(static_cast<void*>(&found), rows + 4 * k, sizeof found);
    if (precedes(found, packet.first[slot + static_cast<int>(k)])) nearer |= 1u << k;
  }
  hn::StoreU(select(mask_of_bits(nearer), t, known).v, d, packet.distance + slot);
  Hit* const to = packet.first + slot;
  if (nearer == (1u << lane_width) - 1) {
    std::memcpy(static_cast<void*>(to), rows, sizeof rows);
  } else {
    for (std::uint32_t left = nearer; left != 0; left &= left - 1) {
      const auto k = static_cast<std::uint32_t>(__builtin_ctz(left));
      std::memcpy(static_cast<void*>(to + k), rows + 4 * k, sizeof(Hit));
    }
  }
  return nearer << slot;
}

RAINREF_TARGET_END(compositor)

#endif  // RAINREF_COMPOSITOR_PACKET_LANES_INL_H_
