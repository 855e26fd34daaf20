// The radiance of rays. Every reflection and refraction is followed, without random sampling.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "compositor/scene.h"

namespace rainref::compositor {

struct ShadingOptions {
  int depth = 8;               ///< largest number of surfaces that a path may hit in sequence, at least 1
  double least_weight = 1e-3;  ///< a ray with a smaller share in its pixel is not followed further
};

/// Result of a primary ray.
struct Seen {
  Vec radiance{0, 0, 0};   ///< linear
  Hit hit;                 ///< the first hit
  Vec normal{0, 0, 0};     ///< at the hit, toward the ray, as shaded; 0 if the ray hit nothing
  double film = 0;         ///< [m] that the ray, refracted and never reflected, travels through media that count as film
  bool is_masked = false;  ///< the ray, refracted and never reflected, hits a surface that the mask shows
};

/// Results of many rays, component by component. Arrays are padded to whole lanes.
class SeenColumns {
 public:
  /// Makes room for the results of `count` rays, all black and empty.
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

/// Sets seen[i] to the result of rays[i]. Directions need not be unit vectors; the distance of `hit` is in units of their lengths. At each
/// interface a ray continues as a reflected and a refracted one, weighted by Fresnel's equations for unpolarized light (all of it reflected
/// beyond the critical angle), and media absorb along the way (Beer). A ray that is cut off by `options` sees the surroundings as if
/// nothing were in between, so no light is lost.
///
/// Rays are traced one generation at a time. Each pixel adds up its rays in the order of the generations, and within one in the order of
/// their parents, reflected before refracted. So the result is a pure function of the scene and the ray, independent of other rays.
/// Thread-safe.
///
/// A new ray starts where its parent ended; only hits nearer than the spacing of numbers there are left out. Rounding may put that point on
/// the wrong side of the surface. So a ray that left a surface on one side ignores hits of that surface from the other side, which are
/// impossible. Tracing continues behind such a hit. This requires that a surface that bounds a medium is closed, or closed by others
/// wherever rays can come.
void shade(const Scene& scene, const ShadingOptions& options, std::span<const Ray> rays, std::span<Seen> seen);
/// The same for `count` rays stored component by component.
void shade(const Scene& scene, const ShadingOptions& options, const RayArrays& rays, std::size_t count, SeenColumns& seen);

}  // namespace rainref::compositor
