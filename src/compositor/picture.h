// A traced picture and what goes with it.
#pragma once

#include "compositor/samples.h"
#include "compositor/shading.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::compositor {

/// Row 0 = bottom, as every effect's picture. Means over the samples of a pixel, but for depth.
struct Picture {
  Image beauty;  ///< rgba16f: linear radiance, alpha 1
  Image normal;  ///< rgba16f: mean of the unit normals of the first surfaces, as shaded; alpha: share of samples that met one
  Image depth;   ///< r32f: least distance along the view axis [m]; `far` where every sample met nothing
  Image film;    ///< r16f: length of the refracted ray in media that count as film [m]
  Image mask;    ///< r16f: share of samples that met a masked surface
};
inline constexpr float far = 10000;  ///< [m]

struct PictureOptions {
  ShadingOptions shading;
  int samples = 1;  ///< 1, 4, 8 or 16
};

/// The primary ray through a point of the picture, in pixels from its lower left corner. Its direction has length 1 along
/// the view axis, so that distances of its hits are depths.
Ray primary_ray(const scene::Camera::Basis& basis, const scene::Camera& camera, int width, int height, double x, double y);

/// Traces a picture in tiles. The same bits for every number of threads and every configuration of Embree.
Picture trace_picture(const Scene& scene, const scene::Camera& camera, int width, int height, const PictureOptions& options,
                      const parallel::Executor& executor);

}  // namespace rainref::compositor
