// Rays to floats, several at once; compiled once for each SIMD target.
#include "compositor/extraordinary_ray.h"
#include "compositor/float_rays.h"

#define RAINREF_KERNELS "compositor/kernels_float_rays.cpp"
#include "math/foreach_target.h"
#include "math/real64_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

/// Gives the slots of rays that floats hold near enough.
std::uint32_t RoundPacket(const Packet& packet, const SceneExtent& extent, FloatPacket& out) {
  using R = Real64Lanes;
  const R::D d;
  constexpr int n = static_cast<int>(hn::MaxLanes(R::D()));
  const R zero(0.0), one(1.0), slack(extent.slack()), largest(largest_float);
  const auto smaller = [](R a, R b) HWY_ATTR { return select(b < a, b, a); };
  const auto larger = [](R a, R b) HWY_ATTR { return select(a < b, b, a); };
  std::uint32_t ordinary = 0;
  for (int slot = 0; slot < Packet::slots; slot += n) {
    const auto at = [&](const double* p) HWY_ATTR { return R(hn::Load(d, p + slot)); };
    const auto put = [&](R x, float* p) HWY_ATTR { hn::Store(hn::DemoteTo(NarrowTag(), x.v), NarrowTag(), p + slot); };
    R reach = zero, length = zero;
    for (int k = 0; k < 3; ++k) {
      const R o = at(packet.origin[k]), direction = at(packet.direction[k]);
      reach = larger(reach, abs(o));
      length = larger(length, abs(direction));
      put(o, out.origin[k]);
      put(direction, out.direction[k]);
    }
    put(smaller(larger(at(packet.nearest) * R(0.9999) - slack, zero), largest), out.nearest);
    put(smaller(at(packet.farthest) * R(1.0001) + slack, largest), out.farthest);
    hn::Store(zero.v, d, out.start + slot);
    hn::Store(one.v, d, out.scale + slot);
    const auto near = (reach <= R(extent.reach())).m, long_enough = (length >= R(0.5)).m, short_enough = (length <= R(1024.0)).m;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::And(near, hn::And(long_enough, short_enough)), bits);
    ordinary |= static_cast<std::uint32_t>(bits[0]) << slot;
  }
  return ordinary;
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(RoundPacket);

void make_floats(const Ray* rays, int count, Hit* hits, const SceneExtent& extent, Packet& packet, FloatPacket& out) {
  packet.spread(rays, count, hits);
  out.enters = (1u << count) - 1;
  for_each_lane(out.enters & ~RAINREF_DISPATCH(RoundPacket)(packet, extent, out), [&](std::uint32_t slot) { put_extraordinary_ray(rays[slot], extent, static_cast<int>(slot), out); });
}

}  // namespace rainref::compositor
#endif
