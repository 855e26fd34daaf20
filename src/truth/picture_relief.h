// A picture with depths as a surface for rays, for scenes that come in files.
#pragma once

#include <vector>

#include "image/texture.h"
#include "rainref/image.h"
#include "scene/camera.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// The view of a pinhole camera: each texel is a plate perpendicular to the view axis at its depth, with walls along the view between
/// plates of different depths. So a ray that passes behind an edge ends there, because the picture does not know what it hides. Beyond the
/// picture its outermost texels continue.
class PictureRelief {
 public:
  /// colour: rgba16f; depth: r32f of the same size, along the view axis [m], finite and nonnegative; row 0 = bottom. half_width,
  /// half_height: of the picture on the image plane at distance 1.
  PictureRelief(const scene::Camera& camera, double half_width, double half_height, const Image& colour, const Image& depth);

  struct Sight {
    double distance;  ///< [m]; infinite for a ray that turns away from the picture by more than most_turn
    Vec radiance;     ///< linear
  };
  /// The hit of a ray that begins before the camera. direction: unit. A ray that turns away sees the texel at the picture's edge in its
  /// direction.
  Sight look(const Vec& origin, const Vec& direction) const;

  static constexpr double most_turn_cosine = 0.05;  ///< cosine of the largest angle to the view axis

 private:
  struct Place {
    double x, y;  // texels
  };
  Place place(double x, double y) const { return {(0.5 + x * scale_[0]) * columns_, (0.5 + y * scale_[1]) * rows_}; }
  Vec colour_at(const Place& at) const;
  double depth_at(const Place& at) const;

  Vec eye_;
  scene::Camera::Basis basis_;
  double scale_[2];  // from the image plane to texture coordinates
  int columns_, rows_;
  TextureData colour_;
  std::vector<float> depth_;
};

/// A picture with depths from which objects before the glass are removed.
struct Uncovered {
  Image colour;  ///< rgba32f
  Image depth;   ///< r32f [m]
};

/// Removes objects before the glass from a picture (rgba32f, with depths r32f); the glass's depth in each texel is channel 2 of `surface`
/// (rgba32f). Hidden texels are copied from the nearest texel in the row that is behind the glass, the left one of two. A row without any
/// is copied from the nearest row with some, the lower one of two. If nothing is behind the glass the picture is unchanged.
Uncovered uncovered(const Image& colour, const Image& depth, const Image& surface);

}  // namespace rainref::truth
