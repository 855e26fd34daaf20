// Float rays for culling by Embree, accurate enough that the margin of the boxes covers the difference from the true ray.
//
// Let L be at least the largest coordinate of the scene's boxes. Boxes are enlarged by margin = 2^-18 L. A ray whose origin's coordinates
// add up to at most 2 L reaches every box within 4 L. Rounding its origin and direction to float moves it there by less than 2^-24 (2 + 4)
// L. Embree's slab arithmetic adds 2^-24 (2 + 1) L for its difference and, with two units in the last place for its reciprocal, 2^-24 2 4
// L. Together that is 17/64 of the margin. Other rays are first moved to their entry into the scene, and scaled.
#pragma once

#include "compositor/packet.h"

namespace rainref::compositor {

/// Extent of the boxes of a committed scene.
struct SceneExtent {
  Box box{};           ///< of all boxes, margin included
  double largest = 1;  ///< a power of two, at least the magnitude of every coordinate
  double margin() const { return 0x1p-18 * largest; }
  double reach() const { return 2 * largest; }
  /// Tolerance of Embree's parameter, for directions whose largest component is at least 1/2.
  double slack() const { return 8 * margin(); }
};

/// Up to 16 rays in floats, in borrowed arrays of 16. Embree's parameter on the true ray is t' = (t - start) scale.
struct FloatPacket {
  float *origin[3], *direction[3], *nearest, *farthest;
  bool moved;  ///< some ray has a start other than 0 or a scale other than 1; if false, neither is set
  double start[Packet::slots], scale[Packet::slots];
  std::uint32_t enters;  ///< slots whose rays may enter the scene; the others end before they begin
};

/// The lanes that Embree passes to a callback: all of a packet, or a part of it.
struct EmbreeLanes {
  const int* valid;  ///< -1 or 0
  const unsigned* slot;
  float* end;  ///< end of Embree's ray interval
  int count;   ///< 1, 4, 8 or 16
};

/// Kernels of the selected SIMD target, looked up once for many packets.
struct FloatRayKernels {
  /// Converts rays to separate components; 1 <= count <= slots.
  void (*spread)(const Ray* rays, int count, PacketRoom& out);
  /// Clears the hits of the packet and converts its rays to floats; returns the slots that floats represent accurately enough.
  std::uint32_t (*round)(Packet& packet, const SceneExtent& extent, FloatPacket& out);
  /// The slots of the valid lanes, as a bit mask.
  std::uint32_t (*slots_of)(const EmbreeLanes& lanes);
  /// For lanes whose slots' first hits `changed`: updates the end of Embree's interval, see float_farthest.
  void (*put_ends)(const Packet& packet, const FloatPacket& floats, double slack, std::uint32_t changed, const EmbreeLanes& lanes);
};
FloatRayKernels float_ray_kernels();

/// Clears the hits of the packet, and converts its first `count` rays, of any kind, to floats.
void make_floats(const FloatRayKernels& kernels, int count, const SceneExtent& extent, Packet& packet, FloatPacket& out);

inline constexpr double largest_float = 0x1.fffffep127;
/// End of Embree's interval for a ray with a hit at parameter t': culls nothing that precedes or equals the hit.
inline float float_farthest(double t, double slack) {
  const double far = t * 1.0001 + slack;
  return static_cast<float>(largest_float < far ? largest_float : far);
}

}  // namespace rainref::compositor
