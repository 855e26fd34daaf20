// Surroundings: a picture by direction, and a street, ray by ray.
#pragma once

#include "compositor/scene.h"
#include "image/texture.h"
#include "scene/scenery.h"

namespace rainref::compositor {

/// Rotates directions about the vertical axis, like shade's env_rotation: a direction of azimuth a is looked up at a - angle.
struct Rotation {
  double cosine = 1, sine = 0;
  explicit Rotation(double angle = 0);
  Vec apply(const Vec& d) const { return {cosine * d.x + sine * d.z, d.y, cosine * d.z - sine * d.x}; }
};

/// The radiance of a latitude/longitude or cube texture with mips, linear, looked up as in the passes, in double.
class PictureEnvironment : public Environment {
 public:
  /// The texture must outlive this.
  PictureEnvironment(const Texture& texture, bool is_cube, const Rotation& rotation = Rotation());
  void radiance(const EscapedRays& escaped_rays, std::span<Vec> radiance) const override;

 private:
  const Texture* texture_;
  bool is_cube_;
  Rotation rotation_;
};

/// A street. A sharp ray is traced from its own origin; `offset` [m] is the position of the scene's origin in the street. A blurred ray is
/// looked up in the panorama.
class StreetEnvironment : public Environment {
 public:
  /// Street and panorama (latitude/longitude with mips, linear) must outlive this.
  StreetEnvironment(const scene::Scenery& street, const Vec& offset, const Texture& panorama, const Rotation& rotation = Rotation());
  void radiance(const EscapedRays& escaped_rays, std::span<Vec> radiance) const override;

 private:
  const scene::Scenery* street_;
  Vec offset_;
  PictureEnvironment panorama_;
  Rotation rotation_;
};

}  // namespace rainref::compositor
