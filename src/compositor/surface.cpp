#include "compositor/surface.h"

#include "compositor/packet.h"

namespace rainref::compositor {

void Surface::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  for_each_lane(lanes, [&](std::uint32_t slot) { meet(self, primitive, packet.rays[slot], packet.first[slot]); });
}

void Packet::spread(const Ray* from, int count) {
  rays = from;
  for (int slot = 0; slot < slots; ++slot) {
    const Ray& ray = from[slot < count ? slot : count - 1];
    for (int k = 0; k < 3; ++k) {
      origin[k][slot] = ray.origin[k];
      direction[k][slot] = ray.direction[k];
    }
    nearest[slot] = ray.nearest;
    farthest[slot] = ray.farthest;
  }
}

}  // namespace rainref::compositor
