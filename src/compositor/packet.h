// A few rays side by side, as Embree hands them to a surface.
#pragma once

#include <cstdint>

#include "compositor/surface.h"

namespace rainref::compositor {

/// Up to 16 rays, each in a slot of its own, and their first hits so far.
struct Packet {
  static constexpr int slots = 16;

  const Ray* rays = nullptr;  ///< slot by slot
  Hit first[slots];
  /// The same rays component by component, for surfaces that take several at once; slots without a ray repeat the last.
  alignas(64) double origin[3][slots], direction[3][slots], nearest[slots], farthest[slots];
};

/// Calls visit(slot) for every bit of `lanes`, lowest first.
template <class Visit>
void for_each_lane(std::uint32_t lanes, const Visit& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<std::uint32_t>(__builtin_ctz(lanes)));
}

}  // namespace rainref::compositor
