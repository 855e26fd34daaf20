// Intersects several rays at once with boxes and flat plates, with the same bits as Boxes::meet and Plates::meet.
#pragma once

#include <cstdint>

#include "compositor/packet.h"

namespace rainref::compositor {

/// Like Surface::meet_packet, for the solid box between two corners, seen from outside.
std::uint32_t meet_box(const Vec& low, const Vec& high, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet);

/// A plate in the form of its kernels; see Plate.
struct FlatPlate {
  Vec origin, normal, to_u, to_v;  ///< unit normal; u = to_u . (p - origin), v likewise
  bool is_ellipse;
};
std::uint32_t meet_plate(const FlatPlate& plate, std::uint32_t self, std::uint32_t part, std::uint32_t lanes, Packet& packet);

}  // namespace rainref::compositor
