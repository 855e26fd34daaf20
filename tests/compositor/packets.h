// Packets of rays against the same rays one by one.
#pragma once

#include <gtest/gtest.h>

#include <span>

#include "compositor/packet.h"
#include "random/counter.h"

namespace rainref::compositor::test {

/// Primitives [begin, end) of the surface, whose number is `self`, meet packets of 16 rays, some lanes left out, and must give what
/// each ray finds alone: its first hit, and whether it changed. known(i) is what ray i has met before. Gives how many rays hit. As many
/// rays as fill packets.
template <class Known>
int expect_packets_to_meet_as_rays(const Surface& surface, std::uint32_t self, std::uint32_t begin, std::uint32_t end,
                                   std::span<const Ray> rays, const Known& known) {
  int met = 0;
  for (std::size_t i = 0; i + 16 <= rays.size(); i += 16) {
    const std::uint32_t lanes = i % 32 == 0 ? 0xffff : random::pcg4d({static_cast<std::uint32_t>(i), 1, 2, 3})[0] & 0xffff;
    PacketRoom room;
    Packet packet;
    room.lend_to(packet);
    Hit plain[16], first[16];
    packet.first = first;
    for (std::uint32_t k = 0; k < 16; ++k) {
      const Ray& ray = rays[i + k];
      for (int c = 0; c < 3; ++c) {
        room.component[c][k] = ray.origin[c];
        room.component[3 + c][k] = ray.direction[c];
      }
      room.component[6][k] = ray.nearest;
      room.component[7][k] = ray.farthest;
      plain[k] = known(i + k);
      packet.set_first(k, plain[k]);
    }
    for (std::uint32_t primitive = begin; primitive < end; ++primitive) {
      const std::uint32_t changed = surface.meet_packet(self, primitive, lanes, packet);
      for (std::uint32_t k = 0; k < 16; ++k) {
        const Hit before = plain[k];
        if (lanes >> k & 1) surface.meet(self, primitive, rays[i + k], plain[k]);
        const bool is_same = first[k].t == plain[k].t && first[k].part == plain[k].part && first[k].surface == plain[k].surface &&
                             first[k].u == plain[k].u && first[k].v == plain[k].v && packet.distance[k] == plain[k].t;
        const bool has_changed = before.part != plain[k].part || before.surface != plain[k].surface;
        if (!is_same || (changed >> k & 1) != has_changed) {
          const Ray& r = rays[i + k];
          ADD_FAILURE() << "ray " << i + k << " from " << r.origin.x << " " << r.origin.y << " " << r.origin.z << " along " << r.direction.x
                        << " " << r.direction.y << " " << r.direction.z << ", primitive " << primitive << ": part " << first[k].part
                        << " at " << first[k].t << ", alone part " << plain[k].part << " at " << plain[k].t;
          return met;
        }
      }
    }
    for (const Hit& hit : plain) met += hit.surface == self;
  }
  return met;
}
/// All primitives of surface 0.
template <class Known>
int expect_packets_to_meet_as_rays(const Surface& surface, std::span<const Ray> rays, const Known& known) {
  return expect_packets_to_meet_as_rays(surface, 0, 0, surface.primitives(), rays, known);
}

}  // namespace rainref::compositor::test
