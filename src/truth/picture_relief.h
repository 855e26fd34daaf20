// A picture with depths as rays meet it, where a scene is not made here but comes in files.
#pragma once

#include <vector>

#include "image/texture.h"
#include "rainref/image.h"
#include "scene/camera.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// What a pinhole camera saw: each texel a plate across the view axis at its depth, with walls along the view between plates of different
/// depths. So a ray that passes behind an edge ends there: what the picture hides it does not know. Beyond the picture its outermost
/// texels go on.
class PictureRelief {
 public:
  /// colour: rgba16f; depth: r32f of the same size, along the view axis [m], finite and not below 0; row 0 = bottom.
  /// half_width, half_height: of the picture on the image plane at distance 1.
  PictureRelief(const scene::Camera& camera, double half_width, double half_height, const Image& colour, const Image& depth);

  struct Sight {
    double distance;  ///< [m]; infinite for a ray that turns away from the picture by more than most_turn
    Vec radiance;     ///< linear
  };
  /// What a ray meets that begins before the camera. direction: unit. One that turns away sees the texel at the picture's edge where its
  /// direction points.
  Sight look(const Vec& origin, const Vec& direction) const;

  static constexpr double most_turn_cosine = 0.05;  ///< to the view axis

 private:
  struct Place {
    double x, y;  // texels
  };
  Place place(double x, double y) const { return {(0.5 + x * scale_[0]) * columns_, (0.5 + y * scale_[1]) * rows_}; }
  Vec colour_at(const Place& at) const;
  double depth_at(const Place& at) const;

  Vec eye_;
  scene::Camera::Basis basis_;
  double scale_[2];  // of the image plane to texture coordinates
  int columns_, rows_;
  TextureData colour_;
  std::vector<float> depth_;
};

/// A picture with depths without what stands before the glass.
struct Uncovered {
  Image colour;  ///< rgba32f
  Image depth;   ///< r32f [m]
};

/// What a picture (rgba32f, with depths r32f) shows behind the glass, whose depth in each texel is channel 2 of `surface` (rgba32f). What
/// something nearer hides is not known: it is taken to be like the nearest texel of the row that is behind the glass, the left one of two,
/// and a row without any like the nearest row with some, the lower one of two. Where nothing is behind the glass the picture stays.
Uncovered uncovered(const Image& colour, const Image& depth, const Image& surface);

}  // namespace rainref::truth
