// A traced picture and its auxiliary channels.
#pragma once

#include <array>
#include <span>

#include "compositor/shading.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::compositor {

/// A position in a pixel, relative to its centre, in pixels: x to the right, y up, both in [-1/2, 1/2).
struct Sample {
  double x, y;
};
/// The supported numbers of samples.
inline constexpr std::array<int, 4> sample_counts{1, 4, 8, 16};
/// The pattern of this number of samples, with equal weights (box filter). They are the standard multisample positions of Direct3D 11 and
/// Vulkan, in sixteenths of a pixel: one at the centre, or a rotated grid in which no two samples share a row or a column. Throws
/// Error(usage) for another count.
std::span<const Sample> samples(int count);

/// Row 0 = bottom, as in every effect's picture. Means over the samples of a pixel, except for depth.
struct Picture {
  Image beauty;  ///< rgba16f: linear radiance, alpha 1
  Image normal;  ///< rgba16f: mean of the unit normals of the first surfaces, as shaded; alpha: share of samples that hit a surface
  Image depth;   ///< r32f: smallest distance along the view axis [m]; `far` if every sample hit nothing
  Image film;    ///< r16f: length of the refracted ray in media that count as film [m]
  Image mask;    ///< r16f: share of samples that hit a masked surface, refracted and never reflected before
};
inline constexpr float far = 10000;  ///< [m]

struct PictureOptions {
  ShadingOptions shading;
  int samples = 1;  ///< 1, 4, 8 or 16
};

/// The rays of a camera's pixels. A direction has length 1 along the view axis, so that distances of its hits are depths.
class PrimaryRays {
 public:
  PrimaryRays(const scene::Camera& camera, int width, int height);
  /// The ray through a point of the picture, in pixels from its lower left corner.
  Ray through(double x, double y) const { return {position_, corner_ + x * across_ + y * up_}; }

 private:
  Vec position_, corner_, across_, up_;
};

/// Traces a picture in tiles. The bits are the same for every number of threads and every configuration of Embree.
Picture trace_picture(const Scene& scene, const scene::Camera& camera, int width, int height, const PictureOptions& options,
                      const parallel::Executor& executor);

}  // namespace rainref::compositor
