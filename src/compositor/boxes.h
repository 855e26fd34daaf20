// Solid axis-aligned boxes.
#pragma once

#include <vector>

#include "compositor/surface.h"

namespace rainref::compositor {

/// One part, and one primitive, for each box, in the order given. A ray that starts inside a box does not see it. u and v of hits are 0.
class Boxes final : public Surface {
 public:
  explicit Boxes(std::vector<Box> boxes) : boxes_(std::move(boxes)) {}

  std::uint32_t primitives() const override { return static_cast<std::uint32_t>(boxes_.size()); }
  Box bounds(std::uint32_t primitive) const override { return boxes_[primitive]; }
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  std::uint32_t meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;

 private:
  std::vector<Box> boxes_;
};

}  // namespace rainref::compositor
