// Converts several rays to floats at once; compiled once for each SIMD target.
#include <algorithm>
#include <limits>

#include "compositor/extraordinary_ray.h"
#include "compositor/float_rays.h"

#define RAINREF_KERNELS "compositor/kernels_float_rays.cpp"
#include "math/foreach_target.h"
#include "compositor/packet_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

using R = Real64Lanes;
constexpr int n = lane_width;

/// Transposes a vector of rays to separate components.
HWY_INLINE HWY_ATTR void transpose(const double* const* rays, double* const* components, int slot) {
#if HWY_TARGET == HWY_AVX3
  const R::D d;
  R::V v[8];
  for (int k = 0; k < 8; ++k) v[k] = hn::LoadU(d, rays[k]);
  for (int odd = 0; odd < 2; ++odd) {
    // Blocks of two: in block b, component 2 b + odd of two rays.
    R::V a[4];
    for (int k = 0; k < 4; ++k)
      a[k] = odd ? hn::InterleaveUpper(d, v[2 * k], v[2 * k + 1]) : hn::InterleaveLower(d, v[2 * k], v[2 * k + 1]);
    const auto even01 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(a[1]), a[0]),
               odd01 = hn::OddEvenBlocks(a[1], hn::SwapAdjacentBlocks(a[0]));
    const auto even23 = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(a[3]), a[2]),
               odd23 = hn::OddEvenBlocks(a[3], hn::SwapAdjacentBlocks(a[2]));
    hn::Store(hn::ConcatLowerLower(d, even23, even01), d, components[odd] + slot);
    hn::Store(hn::ConcatLowerLower(d, odd23, odd01), d, components[2 + odd] + slot);
    hn::Store(hn::ConcatUpperUpper(d, even23, even01), d, components[4 + odd] + slot);
    hn::Store(hn::ConcatUpperUpper(d, odd23, odd01), d, components[6 + odd] + slot);
  }
#else
  for (int k = 0; k < n; ++k) {
    for (int c = 0; c < 8; ++c) components[c][slot + k] = rays[k][c];
  }
#endif
}

void SpreadRays(const Ray* rays, int count, PacketRoom& out) {
  static_assert(sizeof(Ray) == 8 * sizeof(double));
  double* components[8];
  for (int c = 0; c < 8; ++c) components[c] = out.component[c];
  for (int slot = 0; slot < Packet::slots; slot += n) {
    const double* from[n];
    for (int k = 0; k < n; ++k) from[k] = &rays[slot + k < count ? slot + k : count - 1].origin.x;
    transpose(from, components, slot);
  }
}

std::uint32_t RoundPacket(Packet& packet, const SceneExtent& extent, FloatPacket& out) {
  const R::D d;
  const NarrowTag narrow;
  const R zero(0.0), slack(extent.slack()), largest(largest_float);
  std::uint32_t ordinary = 0;
  // Two hits per vector of 64 bytes; a narrower vector holds a part of the pattern.
  const Hit none[2];
  static_assert(sizeof none % sizeof(zero.v) == 0);
  _Pragma("GCC unroll 8") for (std::size_t i = 0; i < Packet::slots * sizeof(Hit); i += sizeof(zero.v)) {
    const auto part = hn::LoadU(d, reinterpret_cast<const double*>(reinterpret_cast<const char*>(none) + i % sizeof none));
    hn::StoreU(part, d, reinterpret_cast<double*>(reinterpret_cast<char*>(packet.first) + i));
  }
  _Pragma("GCC unroll 2") for (int slot = 0; slot < Packet::slots; slot += n) {
    hn::StoreU(R(std::numeric_limits<double>::infinity()).v, d, packet.distance + slot);
    const auto rounded = [&](const double* p) HWY_ATTR { return hn::DemoteTo(narrow, hn::LoadU(d, p + slot)); };
    const auto put = [&](R x, float* p) HWY_ATTR { hn::StoreU(hn::DemoteTo(narrow, x.v), narrow, p + slot); };
    // Uses the rounded numbers, whose error of a millionth is far below the spare margins. Sums keep a NaN.
    auto reach = hn::Zero(narrow), length = reach, sum = reach;
    _Pragma("GCC unroll 3") for (int k = 0; k < 3; ++k) {
      const auto o = rounded(packet.origin[k]), direction = rounded(packet.direction[k]);
      reach = hn::Add(reach, hn::Abs(o));
      length = hn::Max(length, hn::Abs(direction));
      sum = hn::Add(sum, hn::Abs(direction));
      hn::StoreU(o, narrow, out.origin[k] + slot);
      hn::StoreU(direction, narrow, out.direction[k] + slot);
    }
    put(minimum(largest, maximum(zero, load_slots(packet.nearest + slot) * R(0.9999) - slack)), out.nearest);
    put(minimum(largest, load_slots(packet.farthest + slot) * R(1.0001) + slack), out.farthest);
    const auto near = hn::Le(reach, hn::Set(narrow, static_cast<float>(extent.reach())));
    const auto length_fits = hn::And(hn::Ge(length, hn::Set(narrow, 0.5f)), hn::Le(sum, hn::Set(narrow, 1024.0f)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(narrow, hn::And(near, length_fits), bits);
    ordinary |= static_cast<std::uint32_t>(bits[0]) << slot;
  }
  return ordinary;
}

using LaneSlots = hn::RebindToSigned<FloatTag>;
constexpr int lanes_at_once = static_cast<int>(hn::MaxLanes(LaneSlots()));
static_assert(lanes_at_once <= Packet::slots);

/// Whether that many lanes exist from i on and have neighbouring slots: Embree divides packets but keeps the order.
HWY_INLINE HWY_ATTR bool are_neighbours(const EmbreeLanes& lanes, int i) {
  const LaneSlots d;
  return i + lanes_at_once <= lanes.count && hn::AllTrue(d, hn::Eq(hn::LoadU(d, reinterpret_cast<const std::int32_t*>(lanes.slot + i)),
                                                                   hn::Iota(d, static_cast<std::int32_t>(lanes.slot[i]))));
}
HWY_INLINE HWY_ATTR hn::Mask<FloatTag> are_valid(const EmbreeLanes& lanes, int i) {
  return hn::RebindMask(FloatTag(), hn::Ne(hn::LoadU(LaneSlots(), lanes.valid + i), hn::Zero(LaneSlots())));
}

std::uint32_t SlotsOf(const EmbreeLanes& lanes) {
  std::uint32_t slots = 0;
  int i = 0;
  for (; are_neighbours(lanes, i); i += lanes_at_once) slots |= bits_of(are_valid(lanes, i)) << lanes.slot[i];
  for (; i < lanes.count; ++i) slots |= static_cast<std::uint32_t>(lanes.valid[i] & 1) << lanes.slot[i];
  return slots;
}

/// Ends of Embree's intervals for the rays in `slot` and the next ones.
HWY_INLINE HWY_ATTR hn::Vec<NarrowTag> ends(const Packet& packet, const FloatPacket& floats, double slack, int slot) {
  const R largest(largest_float);
  R t = load_slots(packet.distance + slot);
  if (floats.moved) t = (t - load_slots(floats.start + slot)) * load_slots(floats.scale + slot);
  const R far = t * R(1.0001) + R(slack);
  return hn::DemoteTo(NarrowTag(), select(largest < far, largest, far).v);
}

void PutEnds(const Packet& packet, const FloatPacket& floats, double slack, std::uint32_t changed, const EmbreeLanes& lanes) {
  const FloatTag d;
  HWY_ALIGN float by_slot[Packet::slots];
  _Pragma("GCC unroll 2") for (int slot = 0; slot < Packet::slots; slot += n) {
    hn::StoreU(ends(packet, floats, slack, slot), NarrowTag(), by_slot + slot);
  }
  int i = 0;
  for (; are_neighbours(lanes, i); i += lanes_at_once) {
    const unsigned slot = lanes.slot[i];
    const auto takes = hn::And(float_mask_of_bits(changed >> slot), are_valid(lanes, i));
    hn::StoreU(hn::IfThenElse(takes, hn::LoadU(d, by_slot + slot), hn::LoadU(d, lanes.end + i)), d, lanes.end + i);
  }
  for (; i < lanes.count; ++i) {
    if ((changed >> lanes.slot[i] & static_cast<std::uint32_t>(lanes.valid[i]) & 1) != 0) lanes.end[i] = by_slot[lanes.slot[i]];
  }
}

FloatRayKernels Kernels() { return {SpreadRays, RoundPacket, SlotsOf, PutEnds}; }

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(Kernels);

FloatRayKernels float_ray_kernels() { return RAINREF_DISPATCH(Kernels)(); }

void make_floats(const FloatRayKernels& kernels, int count, const SceneExtent& extent, Packet& packet, FloatPacket& out) {
  out.enters = (1u << count) - 1;
  out.moved = false;
  for_each_lane(out.enters & ~kernels.round(packet, extent, out),
                [&](std::uint32_t slot) { put_extraordinary_ray(packet.ray(slot), extent, static_cast<int>(slot), out); });
  // When Embree divides a packet it ignores which rays are valid, but leaves out those that end before they begin.
  for_each_lane(~out.enters & ((1u << Packet::slots) - 1),
                [&](std::uint32_t slot) { out.farthest[slot] = -std::numeric_limits<float>::infinity(); });
}

}  // namespace rainref::compositor
#endif
