// A pane of glass with thickness: its outer face, flat, sheared or bent, and coordinates (u, v) on it.
#pragma once

#include "compositor/surface.h"

namespace rainref::compositor {

/// Shape of a pane. If it is flat, the outer face at (u, v) in [0, 1]^2 is corner + u e_u + v e_v.
struct PaneShape {
  Vec corner, e_u, e_v;     ///< [m]
  Vec outside;              ///< any direction that leaves the pane through its outer face
  double thickness = 5e-3;  ///< [m], > 0
  /// 0: flat. Else the outer face is part of a cylinder of this radius [m] through the edges u = 0 and u = 1, convex outward; u is
  /// proportional to arc length. The inner face is concentric.
  double radius = 0;
};

/// Intersection of a line with a face.
struct PanePoint {
  double t, u, v;
};
/// A point near the pane: its foot (u, v) on the outer face and its height over it [m].
struct PaneCoordinates {
  double u, v, lift;
};

class Pane {
 public:
  /// Throws Error(usage) if the corners span no plane, `outside` lies in it, the thickness is not positive, or if a bent pane's edges are
  /// not perpendicular (to 1e-9) or its radius is below half its chord or its thickness.
  explicit Pane(const PaneShape& shape);

  const PaneShape& shape() const { return shape_; }
  bool is_flat() const { return shape_.radius == 0; }
  /// The point `lift` metres outward of the outer face; the inner face has lift -thickness.
  Vec point(double u, double v, double lift = 0) const;
  PaneCoordinates coordinates(const Vec& p) const;
  /// Unit, outward.
  Vec normal(double u) const;
  /// The unit outward normal of a surface over the face that rises by rise_u per unit of u and by rise_v per unit of v [m]: n - grad h,
  /// normalized, with grad h the tangent vector whose products with the tangents of u and v are the rises.
  Vec tilted(double u, double rise_u, double rise_v) const;
  /// Intersections of the ray's infinite line with the face at `lift`, in the order of t, ignoring the limits of the ray; u and v may lie
  /// beyond the pane. Returns their number: 0 or 1 for a flat face, 0 to 2 for a bent one.
  int crossings(const Ray& ray, double lift, PanePoint (&points)[2]) const;
  /// Bounds of the faces of all lifts from low to high.
  Box bounds(double low, double high) const;

 private:
  PaneShape shape_;
  Vec normal_;           // flat: of the face; bent: at u = 1/2
  Vec dual_u_, dual_v_;  // flat: u = (p - corner) . dual_u
  // Bent: p = axis + r (sin a across + cos a normal) + v e_v, a = (2 u - 1) half_angle.
  Vec axis_, across_, along_;
  double half_angle_ = 0, length_ = 0;
};

/// One face of a pane: part 0, u and v of a hit are those of the pane.
class PaneFace : public Surface {
 public:
  PaneFace(const Pane& pane, double lift) : pane_(pane), lift_(lift) {}
  const Pane& pane() const { return pane_; }
  std::uint32_t primitives() const override { return 1; }
  Box bounds(std::uint32_t) const override { return pane_.bounds(lift_, lift_); }
  void meet(std::uint32_t self, std::uint32_t, const Ray& ray, Hit& first) const override;
  Vec normal(const Ray&, const Hit& hit) const override { return pane_.normal(hit.u); }

 protected:
  /// Whether the face exists at (u, v), a point of the pane.
  virtual bool is_there(double, double) const { return true; }

 private:
  Pane pane_;
  double lift_;
};

/// The frame of the pane: a wall around it, from its inner face to `height` metres outward of its outer face, so that no light leaves
/// through its edges. Part = u 0, u 1, v 0, v 1.
class PaneRim : public Surface {
 public:
  PaneRim(const Pane& pane, double height) : pane_(pane), height_(height) {}
  std::uint32_t primitives() const override { return 4; }
  Box bounds(std::uint32_t primitive) const override;
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;

 private:
  Vec wall_normal(std::uint32_t part) const;
  Pane pane_;
  double height_;
};

}  // namespace rainref::compositor
