// A few rays side by side, as Embree passes them to a surface.
#pragma once

#include <cstdint>

#include "compositor/surface.h"

namespace rainref::compositor {

/// Up to 16 rays component by component, each in its own slot, and their first hits so far. Every array has 16 values, which may all be
/// read, and the hits written; slots without a ray repeat the last one.
struct Packet {
  static constexpr int slots = 16;

  const double *origin[3], *direction[3], *nearest, *farthest;
  Hit* first;
  alignas(64) double distance[slots];  ///< copy of the first hits' t, contiguous

  void set_first(std::uint32_t slot, const Hit& hit) {
    first[slot] = hit;
    distance[slot] = hit.t;
  }
  Ray ray(std::uint32_t slot) const {
    return {{origin[0][slot], origin[1][slot], origin[2][slot]},
            {direction[0][slot], direction[1][slot], direction[2][slot]},
            nearest[slot],
            farthest[slot]};
  }
};

/// Storage for the components of a packet that are not already in arrays.
struct PacketRoom {
  alignas(64) double component[8][Packet::slots];
  void lend_to(Packet& packet) const {
    for (int k = 0; k < 3; ++k) {
      packet.origin[k] = component[k];
      packet.direction[k] = component[3 + k];
    }
    packet.nearest = component[6];
    packet.farthest = component[7];
  }
};

/// Calls visit(slot) for every bit of `lanes`, lowest first.
template <class Visit>
void for_each_lane(std::uint32_t lanes, const Visit& visit) {
  for (; lanes != 0; lanes &= lanes - 1) visit(static_cast<std::uint32_t>(__builtin_ctz(lanes)));
}

}  // namespace rainref::compositor
