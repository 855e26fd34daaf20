// The radiance of rays: every reflection and refraction followed, nothing left to chance.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "compositor/scene.h"

namespace rainref::compositor {

struct ShadingOptions {
  int depth = 8;               ///< surfaces that a path may meet one after the other, at least 1
  double least_weight = 1e-3;  ///< a ray whose share in its pixel is below this is followed no further
};

/// What a primary ray sees.
struct Seen {
  Vec radiance{0, 0, 0};   ///< linear
  Hit hit;                 ///< the first one
  Vec normal{0, 0, 0};     ///< at it, toward the ray, as shaded; 0 where the ray met nothing
  double film = 0;         ///< [m] that the ray, refracted and never reflected, runs through media that count as film
  bool is_masked = false;  ///< the ray, refracted and never reflected, meets a surface that the mask shows
};

/// What many rays see, component by component. Arrays go on to whole lanes.
class SeenColumns {
 public:
  /// Room for what `count` rays see, all of it black and empty.
  void clear(std::size_t count) {
    columns_.make_room(count);
    for (int c = 0; c < 8; ++c) std::fill_n(columns_[c], whole_lanes(count), 0.0);
    hits_.resize(whole_lanes(count));
  }
  VecArraysOut radiance() { return columns_.vectors(0); }
  VecArraysOut normal() { return columns_.vectors(3); }
  double* film() { return columns_[6]; }
  double* mask() { return columns_[7]; }  ///< 1 or 0
  Hit* hits() { return hits_.data(); }

 private:
  Columns<8> columns_;
  std::vector<Hit> hits_;
};

/// seen[i] is what rays[i] sees; directions need not be unit vectors, the distance of `hit` counts in their lengths. At each interface a
/// ray goes on as a reflected and a refracted one, weighted by Fresnel's equations for unpolarized light (all of it reflected beyond the
/// critical angle), and media absorb along the way (Beer). A ray that `options` cut off sees the surroundings as if nothing lay between, so
/// no light is lost.
///
/// Rays are traced a generation at a time, and each pixel adds up its rays in the order of the generations, within one in
/// the order of their parents, the reflected before the refracted: a pure function of the scene and the ray, whichever
/// rays lie beside it. From several threads at once.
///
/// A new ray starts where its parent ended; only what is nearer than the spacing of numbers there is left out. Rounding may
/// put that point on the wrong side of the surface; so a ray that left a surface on one side does not see hits of that
/// surface that come from the other side: they contradict where it is. Tracing goes on behind such a hit. For this a
/// surface that bounds a medium has to be closed, or closed by others wherever rays can come.
void shade(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen);
/// The same of `count` rays that lie component by component.
void shade(const Scene& scene, const ShadingOptions& options, const RayArrays& rays, std::size_t count, SeenColumns& seen);

}  // namespace rainref::compositor
