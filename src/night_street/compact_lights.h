// The small bright sources, arranged for loops over all of them: halos in the rain haze and highlights on wet ground.
#pragma once

#include <vector>

#include "night_street/shapes.h"
#include "night_street/vec.h"

namespace rainref::night_street {

struct Source;

/// Structure of arrays in float. Every sum runs over fixed lanes, so that vectors of any width return the same bits. Both
/// effects are exactly zero beyond a reach, so whole groups can be passed over.
struct LightGroup {
  static constexpr std::size_t lanes = 8;
  float x[lanes], y[lanes], z[lanes], red[lanes], green[lanes], blue[lanes];
  float radius[lanes];
  float facing[lanes];  ///< z of the axis of a source that shines along the street, 0 for one that shines all round
  float aside[lanes];   ///< share of its light that such a source sends off its axis; 1 for all round
  Box bounds;
  float largest_radius;
};

class CompactLights {
 public:
  CompactLights() = default;
  /// Keeps the compact ones, ordered along the street.
  explicit CompactLights(const std::vector<Source>& sources);

  /// Light scattered towards the ray's origin by the haze along the first `farthest` metres: linear radiance.
  Vec halo(const Ray& ray, double farthest) const;
  /// Mirror light of all sources from a rough wet surface at `point`, without shadows: a lobe like GGX with its far
  /// tail cut, Schlick's Fresnel, reflectance 0.02 at normal incidence. view = unit vector to the viewer, roughness =
  /// the lobe's slope in (0, 1].
  Vec highlight(const Vec& point, const Vec& view, const Vec& normal, double roughness) const;

 private:
  std::vector<LightGroup> groups_;
};

}  // namespace rainref::night_street
