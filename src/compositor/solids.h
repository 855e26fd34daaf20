// Spheres, boxes, cylinders and convex solids, as the night street stands them up.
#pragma once

#include <vector>

#include "compositor/surface.h"
#include "night_street/shapes.h"

namespace rainref::compositor {

/// One part, and one primitive, for each solid, in the order given; night_street/shapes.h says what a solid is and where
/// a ray meets it. A ray that starts inside a solid does not see it. u and v of hits are 0.
class Solids final : public Surface {
 public:
  Solids(std::vector<night_street::Solid> solids, std::vector<night_street::Plane> planes);

  const std::vector<night_street::Solid>& solids() const { return solids_; }
  std::uint32_t primitives() const override { return static_cast<std::uint32_t>(solids_.size()); }
  Box bounds(std::uint32_t primitive) const override;
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  std::uint32_t meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;

 private:
  std::vector<night_street::Solid> solids_;
  std::vector<night_street::Plane> planes_;
};

}  // namespace rainref::compositor
