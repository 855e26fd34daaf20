// The solids of the street, and their intersections with rays.
#pragma once

#include <vector>

#include "night_street/vec.h"

namespace rainref::night_street {

/// Half-space dot(normal, p) <= offset; a convex solid is the intersection of several.
struct Plane {
  Vec normal;
  double offset;
};

struct Box {
  Vec low, high;
};

/// One solid. The meaning of `a` and `b` depends on the shape.
struct Solid {
  enum Shape : std::uint8_t {
    sphere,  ///< a = centre, b.x = radius
    box,     ///< a = low corner, b = high corner
    pole,    ///< vertical cylinder: a = foot, b.x = radius, b.y = height
    wheel,   ///< cylinder along x: a = centre, b.x = radius, b.y = half width
    convex   ///< planes [first_plane, first_plane + plane_count); a, b = bounds
  } shape = box;
  Vec a, b;
  int material = 0;
  int first_plane = 0, plane_count = 0;
  int sign = -1;  ///< index of the sign painted on this box, or -1

  Box bounds() const;
};

struct SolidHit {
  double t;
  Vec normal;  ///< unit, outward
};

/// The first entry of the ray into the solid with t in (nearest, farthest); false if there is none. A ray that starts inside a solid does
/// not see it.
bool intersect(const Solid& solid, const std::vector<Plane>& planes, const Ray& ray, double nearest, double farthest, SolidHit& hit);

/// Whether the ray crosses the box within (0, farthest), and the t of its entry; entry < 0 if it starts inside.
inline bool crosses(const Box& box, const Ray& ray, double farthest, double& entry) {
  const double x0 = (box.low.x - ray.origin.x) * ray.reciprocal.x, x1 = (box.high.x - ray.origin.x) * ray.reciprocal.x;
  const double y0 = (box.low.y - ray.origin.y) * ray.reciprocal.y, y1 = (box.high.y - ray.origin.y) * ray.reciprocal.y;
  const double z0 = (box.low.z - ray.origin.z) * ray.reciprocal.z, z1 = (box.high.z - ray.origin.z) * ray.reciprocal.z;
  entry = max_of(max_of(min_of(x0, x1), min_of(y0, y1)), min_of(z0, z1));
  const double exit = min_of(min_of(max_of(x0, x1), max_of(y0, y1)), max_of(z0, z1));
  return entry <= exit && exit > 0 && entry < farthest;
}

/// The outward normal of the face through which the ray enters the box.
Vec entry_normal(const Box& box, const Ray& ray);

}  // namespace rainref::night_street
