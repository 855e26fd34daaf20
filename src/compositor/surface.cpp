#include "compositor/surface.h"

#include "base/floating_point.h"
#include "compositor/packet.h"

namespace rainref::compositor {

std::uint32_t Surface::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  std::uint32_t changed = 0;
  for_each_lane(lanes, [&](std::uint32_t slot) {
    const Hit before = packet.first[slot];
    Hit first = before;
    meet(self, primitive, packet.ray(slot), first);
    if (first.t == before.t && first.surface == before.surface && first.part == before.part) return;
    packet.set_first(slot, first);
    changed |= 1u << slot;
  });
  return changed;
}

void Surface::normals(const RayArrays& rays, std::span<const std::uint32_t> which, const Hit* hits, const VecArraysOut& normals) const {
  for (std::size_t k = 0; k < which.size(); ++k) normals.put(k, normal(rays[which[k]], hits[k]));
}

Hit first_hit_of_all(std::span<const std::shared_ptr<const Surface>> surfaces, const Ray& ray) {
  const FloatingPointGuard guard;
  Hit first;
  for (std::uint32_t self = 0; self < surfaces.size(); ++self) {
    for (std::uint32_t i = 0; i < surfaces[self]->primitives(); ++i) surfaces[self]->meet(self, i, ray, first);
  }
  return first;
}

}  // namespace rainref::compositor
