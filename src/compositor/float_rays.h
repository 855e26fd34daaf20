// Rays as Embree culls with them: floats, near enough to the true ray that the margin of the boxes covers the difference.
//
// Let L be at least the largest coordinate of the scene's boxes. Boxes are enlarged by margin = 2^-18 L. A ray whose origin's
// coordinates add up to 2 L at most reaches every box within 4 L; rounded to float it strays there by less than 2^-24 (2 + 4) L
// for its origin and direction. Embree's slab arithmetic adds 2^-24 (2 + 1) L for its difference and, with two units in the
// last place for its reciprocal, 2^-24 2 4 L. Together that is 17/64 of the margin. Other rays are first moved to where they
// enter the scene, and scaled.
#pragma once

#include "compositor/packet.h"

namespace rainref::compositor {

/// The boxes of a committed scene.
struct SceneExtent {
  Box box{};           ///< of everything, margin included
  double largest = 1;  ///< a power of two, at least every coordinate by magnitude
  double margin() const { return 0x1p-18 * largest; }
  double reach() const { return 2 * largest; }
  /// Of Embree's parameter, for directions whose largest component is at least 1/2.
  double slack() const { return 8 * margin(); }
};

/// Up to 16 rays in floats, in arrays of 16 that someone lends. Where Embree's parameter t' lies on the true ray:
/// t' = (t - start) scale.
struct FloatPacket {
  float *origin[3], *direction[3], *nearest, *farthest;
  bool moved;  ///< some ray has another start than 0 or another scale than 1; without one, neither is set
  double start[Packet::slots], scale[Packet::slots];
  std::uint32_t enters;  ///< slots whose rays do not pass the whole scene by; the others end before they begin
};

/// The lanes that Embree hands to a callback: all of a packet, or a piece of it.
struct EmbreeLanes {
  const int* valid;  ///< -1 or 0
  const unsigned* slot;
  float* end;  ///< Embree's farthest
  int count;   ///< 1, 4, 8 or 16
};

/// Kernels of the SIMD target that is chosen, found once for many packets.
struct FloatRayKernels {
  /// Component by component, what lies ray by ray; 1 <= count <= slots.
  void (*spread)(const Ray* rays, int count, PacketRoom& out);
  /// Makes the hits of the packet none and its rays floats; returns the slots of those that floats hold near enough.
  std::uint32_t (*round)(Packet& packet, const SceneExtent& extent, FloatPacket& out);
  /// The slots of the valid lanes, a bit for each.
  std::uint32_t (*slots_of)(const EmbreeLanes& lanes);
  /// For lanes whose slots' first hits `changed`: what Embree may take for their ends by now, see float_farthest.
  void (*put_ends)(const Packet& packet, const FloatPacket& floats, double slack, std::uint32_t changed, const EmbreeLanes& lanes);
};
FloatRayKernels float_ray_kernels();

/// Makes the hits of the packet none, and gives its first `count` rays in floats, whatever they are.
void make_floats(const FloatRayKernels& kernels, int count, const SceneExtent& extent, Packet& packet, FloatPacket& out);

inline constexpr double largest_float = 0x1.fffffep127;
/// What Embree may take for the end of a ray that has a hit at parameter t': nothing that precedes or equals it is culled.
inline float float_farthest(double t, double slack) {
  const double far = t * 1.0001 + slack;
  return static_cast<float>(largest_float < far ? largest_float : far);
}

}  // namespace rainref::compositor
