// Surfaces that rays can hit, and the definition of the first hit.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "compositor/columns.h"

namespace rainref::compositor {

/// A point [m] or a direction, in the scene's axes.
using Vec = glm::dvec3;

/// origin + t direction; the direction is finite and not zero, but need not be a unit vector. Hits outside [nearest, farthest] are ignored;
/// nearest >= 0.
struct Ray {
  Vec origin, direction;
  double nearest = 0, farthest = std::numeric_limits<double>::infinity();
  Vec at(double t) const { return origin + t * direction; }
};

/// Rays component by component.
struct RayArrays {
  const double *origin[3], *direction[3], *nearest, *farthest;
  Ray operator[](std::size_t i) const {
    return {{origin[0][i], origin[1][i], origin[2][i]}, {direction[0][i], direction[1][i], direction[2][i]}, nearest[i], farthest[i]};
  }
};

/// A hit of a ray on a surface.
struct Hit {
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t surface = none;  ///< number of the surface, in the order in which they were added
  std::uint32_t part = none;     ///< triangle, solid, ... in the surface's numbering; not the primitive that Embree culls
  double u = 0, v = 0;           ///< position on the part, as the surface defines it
  bool is_surface() const { return surface != none; }
};

/// Hits are ordered by distance, then by surface, then by part, so the first one does not depend on how it was found.
inline bool precedes(const Hit& a, const Hit& b) {
  return a.t != b.t ? a.t < b.t : a.surface != b.surface ? a.surface < b.surface : a.part < b.part;
}

struct Box {
  Vec low, high;
};

struct Packet;

/// A surface, divided into primitives that Embree culls by their bounds. Immutable while rays are traced.
class Surface {
 public:
  virtual ~Surface() = default;
  /// Changes whenever bounds or primitives do, so that Tracer::commit knows what to update.
  virtual std::uint64_t revision() const { return 0; }
  virtual std::uint32_t primitives() const = 0;
  /// Contains everything of a primitive that a ray can hit; the tracer adds the margin that Embree's float boxes need.
  virtual Box bounds(std::uint32_t primitive) const = 0;
  /// Replaces `first` by every hit of the primitive within the ray's limits that precedes it. `self` is this surface's number. Uses only
  /// operations of the determinism contract, in double.
  virtual void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const = 0;
  /// The same for every slot in the bit set `lanes`, with the same bits; returns the slots whose first hit changed. Surfaces with a faster
  /// version override it.
  virtual std::uint32_t meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const;
  /// The geometric normal at a hit: unit, on the outside of the surface.
  virtual Vec normal(const Ray& ray, const Hit& hit) const = 0;
  /// The same for many hits, with the same bits: normals[k] is that of rays[which[k]] at hits[k]. Hits and `which` are padded to whole
  /// lanes by repeating the last one. Surfaces with a faster version override it.
  virtual void normals(const RayArrays& rays, std::span<const std::uint32_t> which, const Hit* hits, const VecArraysOut& normals) const;
};

/// The first hit among all surfaces, found by testing every primitive: the oracle of the tests for Tracer.
Hit first_hit_of_all(std::span<const std::shared_ptr<const Surface>> surfaces, const Ray& ray);

}  // namespace rainref::compositor
