// The puddle's passes against the traced puddle.
#pragma once

#include "truth/puddle_scene.h"
#include "truth/difference.h"

namespace rainref::truth {

/// How the march and shade of a puddle err in one picture, at pixel centres. `puddle` has rendered the water that `traced` was updated
/// with; colours are compared at one ray a pixel.
///   pixels                     pixels, water_in_both; water_in_passes_only and water_in_truth_only: along the shore
///   hit_distance [m]           along the view ray, where both see water
///   normal_angle [deg], ground_offset [m]: there; how far the refracted rays' ends on the bed lie apart
///   colour, display            there: the channel that differs most, linear radiance, and code values of 255 of what is shown
///   ground_display             the same where the truth sees ground
///   schlick                    Schlick's reflectance minus Fresnel's at the true normal, where the truth sees water
Comparison compare(const puddle::Puddle& puddle, const puddle::Settings& settings, const PuddleScene& traced, const ShadingOptions& options,
                   const parallel::Executor& executor);

/// The picture that the puddle's display makes of a radiance (rgba16f): vignette, exposure, sRGB. rgba8.
Image display(const puddle::Settings& settings, const Image& radiance, const parallel::Executor& executor);

}  // namespace rainref::truth
