// Rays as Embree culls with them: floats, near enough to the true ray that the margin of the boxes covers the difference.
//
// Let L be the largest coordinate of the scene's boxes. Boxes are enlarged by margin = 128 ulp of L = 2^-16 L. A ray that
// starts within 8 L of the axes and is rounded to float strays, at a distance of up to 16 L, by less than 2^-24 (8 + 16) L
// for its origin and direction; Embree's slab arithmetic adds a few roundings of the same size. Together that is below
// 2^-18 L, a quarter of the margin. Other rays are first moved to where they enter the scene, and scaled.
#pragma once

#include "compositor/surface.h"

namespace rainref::compositor {

/// The boxes of a committed scene.
struct SceneExtent {
  Box box{};          ///< of everything, margin included
  double largest = 0; ///< coordinate by magnitude, margins aside
  double margin = 0;
};
inline constexpr double margin_of_largest = 0x1p-16;
inline constexpr double reach_of_largest = 8;

/// Where Embree's parameter t' of a ray lies on the true one: t' = (t - start) scale.
struct FloatRay {
  float origin[3], direction[3], nearest, farthest;
  double start = 0, scale = 1;
  bool enters = true;  ///< false: the ray passes the whole scene by
};

FloatRay float_ray(const Ray& ray, const SceneExtent& extent);

/// Embree's parameter up to which hits must still be found when one is known at t: nothing that precedes or equals it may
/// be culled. slack: of the boxes' margin.
float float_farthest(double t, double slack);
inline double slack_of(const SceneExtent& extent) { return 8 * extent.margin; }

}  // namespace rainref::compositor
