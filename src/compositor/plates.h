// Flat shapes: parallelograms and ellipses.
#pragma once

#include <vector>

#include "compositor/flat_kernels.h"
#include "compositor/surface.h"

namespace rainref::compositor {

/// Points origin + u edge_u + v edge_v, with u and v in [0, 1] for a parallelogram, u^2 + v^2 <= 1 for an ellipse. The
/// outside is on the side of cross(edge_u, edge_v).
struct Plate {
  enum Shape { parallelogram, ellipse } shape = parallelogram;
  Vec origin, edge_u, edge_v;
};

/// One part, and one primitive, for each plate; hit from both sides. Borders belong to the plates, but adjacent plates are not watertight.
class Plates final : public Surface {
 public:
  /// Throws Error(usage) if a plate's edges are parallel or zero.
  explicit Plates(std::vector<Plate> plates);

  std::uint32_t primitives() const override { return static_cast<std::uint32_t>(plates_.size()); }
  Box bounds(std::uint32_t primitive) const override;
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  std::uint32_t meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;

 private:
  std::vector<Plate> plates_;
  std::vector<FlatPlate> flats_;
};

}  // namespace rainref::compositor
