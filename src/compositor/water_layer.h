// Water on the outer face of a pane: its height over the face from a texture, and its surfaces.
//
// If a cell between four texel centres has any water, the face is an interface of glass and water, and the water's surface one of water and
// air. Elsewhere the face is an interface of glass and air, and there is no other surface. The water's surface is `clearance` above its
// height, so that no ray starts on two surfaces at once.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "compositor/heightfield.h"
#include "compositor/pane.h"
#include "compositor/scene.h"
#include "rainref/executor.h"
#include "rainref/image.h"

namespace rainref::compositor {

/// Heights by the pane's (u, v); texel centre (i, j) is at ((i + 1/2) / width, (j + 1/2) / height). Immutable.
class WaterLayer {
 public:
  static constexpr double clearance = 1e-7;  ///< [m]

  /// height: r16f or r32f [mm], the output of pass splat. Negative heights count as none; the outermost texels are dry, so that water ends
  /// on the pane. Throws Error(usage) for another format or fewer than 3 texels a side.
  explicit WaterLayer(const Image& height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Row by row [m].
  const std::vector<float>& metres() const { return metres_; }
  double highest() const { return highest_; }  ///< [m]
  /// Whether there is water in the cell that contains (u, v).
  bool is_wet(double u, double v) const;
  /// The same of the cell between texels (i, j) and (i + 1, j + 1), 0 <= i < width - 1, 0 <= j < height - 1.
  bool is_wet_cell(int i, int j) const {
    return wet_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)] != 0;
  }
  /// dh/du and dh/dv [m]: central differences at the texels, bilinear between them.
  struct Rise {
    double u, v;
  };
  Rise rise(double u, double v) const;
  /// Bilinear between texel centres [m], 0 outside them.
  double at(double u, double v) const;
  /// Height of the facets of DisplacedWater over the face [m]; -1 where it is dry.
  double surface(double u, double v) const;

 private:
  double texel(int i, int j) const;
  int width_, height_;
  double highest_ = 0;
  std::vector<float> metres_;
  std::vector<std::uint8_t> wet_;  // cell (i, j) between texels i and i + 1, j and j + 1
};

/// The dry or the wet part of the pane's outer face.
class OuterFace : public PaneFace {
 public:
  OuterFace(const Pane& pane, std::shared_ptr<const WaterLayer> water, bool wet) : PaneFace(pane, 0), water_(std::move(water)), wet_(wet) {}

 protected:
  bool is_there(double u, double v) const override { return water_->is_wet(u, v) == wet_; }

 private:
  std::shared_ptr<const WaterLayer> water_;
  bool wet_;
};

/// The water's surface on any pane, including bent ones: intersected at the clearance over the face, with the normal of the height's slope
/// there, or the face's normal if the slope turns away from the ray. Light leaves it displaced by up to the water's height times the
/// tangent of its angle to the normal; light reflected sideways does not hit the surface again.
class SlopedWater : public PaneFace {
 public:
  SlopedWater(const Pane& pane, std::shared_ptr<const WaterLayer> water)
      : PaneFace(pane, WaterLayer::clearance), water_(std::move(water)) {}
  Vec normal(const Ray& ray, const Hit& hit) const override;

 protected:
  bool is_there(double u, double v) const override { return water_->is_wet(u, v); }

 private:
  std::shared_ptr<const WaterLayer> water_;
};

/// The actual water surface on a flat pane: a heightfield of the texels over the face, without its dry cells.
class DisplacedWater : public Surface {
 public:
  /// If is_hidden (a pure function) is true for a position, something else is higher and there is no water there. Throws Error(usage) for a
  /// bent pane.
  DisplacedWater(const Pane& pane, std::shared_ptr<const WaterLayer> water, const parallel::Executor& executor,
                 std::function<bool(const Vec&)> is_hidden = {});
  std::uint32_t primitives() const override { return field_.primitives(); }
  Box bounds(std::uint32_t primitive) const override { return field_.bounds(primitive); }
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  std::uint32_t meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override { return field_.normal(ray, hit); }
  void normals(const RayArrays& rays, std::span<const std::uint32_t> which, const Hit* hits, const VecArraysOut& normals) const override {
    field_.normals(rays, which, hits, normals);
  }

 private:
  bool is_there(const Ray& ray, const Hit& hit) const;
  std::shared_ptr<const WaterLayer> water_;
  std::function<bool(const Vec&)> is_hidden_;
  Heightfield field_;
};

/// The smooth normal of the water's surface over the foot of a place, from the slope of the height there.
std::function<Vec(const Place&)> water_normal(const Pane& pane, std::shared_ptr<const WaterLayer> water);

}  // namespace rainref::compositor
