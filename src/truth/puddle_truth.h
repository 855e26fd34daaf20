// The puddle's passes against the traced puddle.
#pragma once

#include <vector>

#include "truth/puddle_scene.h"
#include "truth/difference.h"

namespace rainref::truth {

/// How the march and shade of a puddle err in one picture. Differences are the passes minus the truth, at pixel centres.
struct PuddleTruth {
  std::size_t pixels = 0, water_in_both = 0;
  std::size_t water_in_passes_only = 0, water_in_truth_only = 0;  ///< along the shore
  /// In order: hit_distance [m] along the view ray, normal_angle [deg] and ground_offset [m] (how far the refracted rays'
  /// ends on the bed lie apart), colour (the channel that differs most, linear radiance) and display (the same of what is
  /// shown, code values of 255) where both see water; ground_display where the truth sees ground; schlick (Schlick's
  /// reflectance minus Fresnel's at the true normal) where it sees water.
  std::vector<Difference> differences;
};

/// `puddle` has rendered the water that `traced` was updated with; colours are compared at one ray a pixel.
PuddleTruth compare(const puddle::Puddle& puddle, const puddle::Settings& settings, const PuddleScene& traced,
                    const ShadingOptions& options, const parallel::Executor& executor);

/// The picture that the puddle's display makes of a radiance (rgba16f): vignette, exposure, sRGB. rgba8.
Image display(const puddle::Settings& settings, const Image& radiance, const parallel::Executor& executor);

}  // namespace rainref::truth
