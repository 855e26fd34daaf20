// Boxes and flat plates met by several rays at once, to the bits that Boxes::meet and Plates::meet give.
#pragma once

#include <cstdint>

#include "compositor/packet.h"

namespace rainref::compositor {

/// As Surface::meet_packet, of the solid box between two corners, seen from outside.
std::uint32_t meet_box(const Vec& low, const Vec& high, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet);

/// A plate as its kernels see it; see Plate.
struct FlatPlate {
  Vec origin, normal, to_u, to_v;  ///< unit normal; u = to_u . (p - origin), v likewise
  bool is_ellipse;
};
std::uint32_t meet_plate(const FlatPlate& plate, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet);

}  // namespace rainref::compositor
