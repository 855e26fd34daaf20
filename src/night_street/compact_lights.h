// The small bright sources, arranged for loops over all of them: halos in the rain haze and highlights on wet ground.
#pragma once

#include <vector>

#include "night_street/shapes.h"
#include "night_street/vec.h"

namespace rainref::night_street {

struct Source;

/// Structure of arrays in float. Every sum runs over fixed lanes, so vectors of any width give the same bits. Both effects are exactly zero
/// beyond a limit, so whole groups can be skipped.
struct LightGroup {
  static constexpr std::size_t lanes = 8;
  float x[lanes], y[lanes], z[lanes], red[lanes], green[lanes], blue[lanes];
  float radius[lanes];
  float facing[lanes];  ///< z of the axis of a source that shines along the street, 0 for one that shines in all directions
  float aside[lanes];   ///< share of its light that such a source emits off its axis; 1 for all directions
  Box bounds;
  float largest_radius;
};

class CompactLights {
 public:
  CompactLights() = default;
  /// Keeps the compact sources, ordered along the street.
  explicit CompactLights(const std::vector<Source>& sources);

  /// Linear radiance scattered toward the ray's origin by the haze along the first `farthest` metres.
  Vec halo(const Ray& ray, double farthest) const;
  /// Reflection of all sources in a rough wet surface at `point`, without shadows: a lobe like GGX without its far tail, Schlick's Fresnel,
  /// reflectance 0.02 at normal incidence. view = unit vector to the viewer, roughness = slope of the lobe in (0, 1].
  Vec highlight(const Vec& point, const Vec& view, const Vec& normal, double roughness) const;

 private:
  std::vector<LightGroup> groups_;
};

}  // namespace rainref::night_street
