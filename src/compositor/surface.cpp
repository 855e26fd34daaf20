#include "compositor/surface.h"

#include "compositor/packet.h"

namespace rainref::compositor {

std::uint32_t Surface::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  std::uint32_t changed = 0;
  for_each_lane(lanes, [&](std::uint32_t slot) {
    Hit& first = packet.first[slot];
    const double t = first.t;
    const std::uint32_t surface = first.surface, part = first.part;
    meet(self, primitive, packet.rays[slot], first);
    if (first.t != t || first.surface != surface || first.part != part) changed |= 1u << slot;
  });
  return changed;
}

void Packet::spread(const Ray* from, int count, Hit* hits) {
  rays = from;
  first = hits;
  const auto put = [this](int slot, const Ray& ray) {
    for (int k = 0; k < 3; ++k) {
      origin[k][slot] = ray.origin[k];
      direction[k][slot] = ray.direction[k];
    }
    nearest[slot] = ray.nearest;
    farthest[slot] = ray.farthest;
  };
  for (int slot = 0; slot < count; ++slot) {
    put(slot, from[slot]);
    hits[slot] = Hit{};
  }
  for (int slot = count; slot < slots; ++slot) put(slot, from[count - 1]);
}

}  // namespace rainref::compositor
