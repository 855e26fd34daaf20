// Water on a flat pane: spherical caps, and a layer given by heights where that is higher. Together they are one body without inner walls.
#pragma once

#include <memory>
#include <vector>

#include "compositor/pane_scene.h"

namespace rainref::compositor {

/// A cap's base on the outer face: centre from the pane's corner along u and v, radius [m].
struct CapBase {
  double x, y, radius;
};

/// Selects the water surface over each position of the pane. Immutable.
class CapWater {
 public:
  static constexpr std::uint32_t dry = ~std::uint32_t{0}, layer = dry - 1;  ///< owners other than caps

  /// The pane is flat with perpendicular edges; contact angle in (0, 90) degrees; radii positive. `height`, if given, covers the part of
  /// the pane from (x, y) = low on that is `extent` wide and high [m].
  struct Layer {
    std::shared_ptr<const WaterLayer> height;
    double low[2], extent[2];
  };
  /// Throws Error(usage) for a bent or sheared pane.
  CapWater(const Pane& pane, std::vector<CapBase> caps, double contact_angle_deg, const Layer& height = {});

  const Pane& pane() const { return pane_; }
  const Layer& height() const { return height_; }
  std::uint32_t caps() const { return static_cast<std::uint32_t>(caps_.size()); }
  const CapBase& base(std::uint32_t cap) const { return caps_[cap]; }
  /// Radius of the sphere of a cap, and the lift of its centre, which is not positive.
  double sphere(std::uint32_t cap) const { return caps_[cap].radius / sine_; }
  double centre_lift(std::uint32_t cap) const { return -caps_[cap].radius * (cosine_ / sine_); }
  /// The highest surface over (x, y) [m from the corner]: a cap, the lowest number if equal; `layer`; or `dry`.
  std::uint32_t owner(double x, double y) const;
  bool is_wet(double u, double v) const { return owner(u * width_, v * length_) != dry; }
  double width() const { return width_; }
  double length() const { return length_; }

 private:
  double height_of(std::uint32_t cap, double x, double y) const;
  std::size_t bucket(double x, double y) const;
  Pane pane_;
  std::vector<CapBase> caps_;
  Layer height_;
  double width_, length_, sine_, cosine_, side_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> first_, listed_;  // caps that may cover a bucket: listed_[first_[b]] to listed_[first_[b + 1]]
};

/// The caps' part of the surface, intersected exactly: part = cap.
class CapSurface : public Surface {
 public:
  explicit CapSurface(std::shared_ptr<const CapWater> water) : water_(std::move(water)) {}
  std::uint32_t primitives() const override { return water_->caps(); }
  Box bounds(std::uint32_t primitive) const override;
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;

 private:
  Vec centre(std::uint32_t cap) const;
  std::shared_ptr<const CapWater> water_;
};

/// Adds inner face, outer face, the surfaces of the water, and the rim.
void add_cap_pane(Scene& scene, std::shared_ptr<const CapWater> water, std::shared_ptr<const Opaque> rim,
                  const parallel::Executor& executor, const PaneMedia& media);

}  // namespace rainref::compositor
