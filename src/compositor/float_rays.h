// Rays as Embree culls with them: floats, near enough to the true ray that the margin of the boxes covers the difference.
//
// Let L be at least the largest coordinate of the scene's boxes. Boxes are enlarged by margin = 128 ulp of L = 2^-16 L. A
// ray that starts within 8 L of the axes and is rounded to float strays, at a distance of up to 16 L, by less than
// 2^-24 (8 + 16) L for its origin and direction; Embree's slab arithmetic adds a few roundings of the same size. Together
// that is below 2^-18 L, a quarter of the margin. Other rays are first moved to where they enter the scene, and scaled.
#pragma once

#include "compositor/packet.h"

namespace rainref::compositor {

/// The boxes of a committed scene.
struct SceneExtent {
  Box box{};           ///< of everything, margin included
  double largest = 1;  ///< a power of two, at least every coordinate by magnitude
  double margin() const { return 0x1p-16 * largest; }
  double reach() const { return 8 * largest; }
  /// Of Embree's parameter, for directions whose largest component is at least 1/2.
  double slack() const { return 8 * margin(); }
};

/// Up to 16 rays in floats. Where Embree's parameter t' lies on the true ray: t' = (t - start) scale.
struct FloatPacket {
  alignas(64) float origin[3][Packet::slots], direction[3][Packet::slots], nearest[Packet::slots], farthest[Packet::slots];
  double start[Packet::slots], scale[Packet::slots];
  std::uint32_t enters;  ///< slots whose rays do not pass the whole scene by; the others end before they begin
};

/// Component by component, what lies ray by ray; 1 <= count <= slots.
void spread_rays(const Ray* rays, int count, PacketRoom& out);
/// Makes the hits of the packet none, and gives its first `count` rays in floats.
void make_floats(int count, const SceneExtent& extent, Packet& packet, FloatPacket& out);
/// What Embree may take for the ends of the packet's rays by now, slot by slot; see float_farthest.
void find_ends(const Packet& packet, const FloatPacket& floats, double slack, float* ends);

inline constexpr double largest_float = 0x1.fffffep127;
/// What Embree may take for the end of a ray that has a hit at parameter t': nothing that precedes or equals it is culled.
inline float float_farthest(double t, double slack) {
  const double far = t * 1.0001 + slack;
  return static_cast<float>(largest_float < far ? largest_float : far);
}

}  // namespace rainref::compositor
