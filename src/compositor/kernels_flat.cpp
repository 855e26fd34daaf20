// Boxes and flat plates; compiled once for each SIMD target.
#include "compositor/flat_kernels.h"

#define RAINREF_KERNELS "compositor/kernels_flat.cpp"
#include "math/foreach_target.h"
#include "compositor/packet_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

using R = Real64Lanes;

std::uint32_t MeetBox(const Vec& low, const Vec& high, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet) {
  const R zero(0.0);
  std::uint32_t changed = 0;
  for (int slot = 0; slot < Packet::slots; slot += lane_width) {
    const std::uint32_t here = lanes >> slot & ((1u << lane_width) - 1);
    if (here == 0) continue;
    R from(0.0), to(1e30);
    for (int k = 0; k < 3; ++k) {
      // Reciprocals stay finite, to avoid infinity times zero.
      const R d = load_slots(packet.direction[k] + slot), o = load_slots(packet.origin[k] + slot);
      const LaneMask still = abs(d) < R(1e-30);
      const R inverse = select(still, R(1e30), R(1.0) / select(still, R(1.0), d));
      const R a = (R(low[k]) - o) * inverse, b = (R(high[k]) - o) * inverse;
      from = maximum(from, minimum(a, b));
      to = minimum(to, maximum(a, b));
    }
    const LaneMask hit = mask_of_bits(here) & (from <= to) & (from > zero) & (from >= load_slots(packet.nearest + slot)) &
                         (from <= load_slots(packet.farthest + slot));
    if (!R::any(hit)) continue;
    changed |= take_hits(hit, from, R(part), zero, zero, self, slot, packet);
  }
  return changed;
}

HWY_INLINE HWY_ATTR R along(const Vec& a, R x, R y, R z) { return (R(a.x) * x + R(a.y) * y) + R(a.z) * z; }

std::uint32_t MeetPlate(const FlatPlate& plate, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet) {
  const R zero(0.0), one(1.0);
  std::uint32_t changed = 0;
  for (int slot = 0; slot < Packet::slots; slot += lane_width) {
    const std::uint32_t here = lanes >> slot & ((1u << lane_width) - 1);
    if (here == 0) continue;
    const R ox = load_slots(packet.origin[0] + slot), oy = load_slots(packet.origin[1] + slot), oz = load_slots(packet.origin[2] + slot);
    const R dx = load_slots(packet.direction[0] + slot), dy = load_slots(packet.direction[1] + slot),
            dz = load_slots(packet.direction[2] + slot);
    const R px(plate.origin.x), py(plate.origin.y), pz(plate.origin.z);
    const R closing = along(plate.normal, dx, dy, dz);
    const LaneMask moves = (closing < zero) | (closing > zero);
    const R t = along(plate.normal, px - ox, py - oy, pz - oz) / select(moves, closing, one) + zero;
    const LaneMask in_time =
        mask_of_bits(here) & moves & (t >= load_slots(packet.nearest + slot)) & (t <= load_slots(packet.farthest + slot));
    if (!R::any(in_time)) continue;
    const R x = (ox + t * dx) - px, y = (oy + t * dy) - py, z = (oz + t * dz) - pz;
    const R u = along(plate.to_u, x, y, z), v = along(plate.to_v, x, y, z);
    const LaneMask hit = in_time & (plate.is_ellipse ? u * u + v * v <= one : (u >= zero) & (u <= one) & (v >= zero) & (v <= one));
    if (!R::any(hit)) continue;
    changed |= take_hits(hit, t, R(part), u, v, self, slot, packet);
  }
  return changed;
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(MeetBox);
RAINREF_EXPORT(MeetPlate);

std::uint32_t meet_box(const Vec& low, const Vec& high, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet) {
  return RAINREF_DISPATCH(MeetBox)(low, high, self, part, lanes, packet);
}
std::uint32_t meet_plate(const FlatPlate& plate, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet) {
  return RAINREF_DISPATCH(MeetPlate)(plate, self, part, lanes, packet);
}

}  // namespace rainref::compositor
#endif
