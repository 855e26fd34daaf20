// What composite makes of a wet windshield against what rays make of it.
#pragma once

#include <vector>

#include "truth/difference.h"
#include "truth/windshield_view.h"

namespace rainref::truth {

/// A pixel is a drop's where composite shows it as one by half or more, else the film's.
struct WindshieldTruth {
  std::size_t glass = 0, drops = 0;  ///< pixels on the glass, and those of drops among them
  std::size_t mirrored = 0;          ///< drops' pixels whose ray meets the water's surface beyond the critical angle
  /// In order, composite minus truth, on the glass:
  ///   refraction [deg]         drops: between the place outside that composite shows and the one that the refracted ray
  ///                            meets, as the eye sees them; not where the ray is mirrored
  ///   refraction_film [deg]    the same where there is neither drop nor water: what the pane alone does
  ///   colour, colour_film      linear radiance, the channel that differs most: drops, and the rest
  ///   display                  everywhere: code values of 255, the channel that differs most
  std::vector<Difference> differences;
};

/// `rendered` has rendered a frame, whose pictures `view` shows where it is not of the street. Refraction by the ray through the pixel's
/// centre, colours by options.samples rays.
WindshieldTruth compare(const windshield::Windshield& rendered, const WindshieldView& view, const PictureOptions& options,
                        const parallel::Executor& executor);

/// The picture that the windshield's display makes of a radiance (rgba16f). rgba8.
Image display(const windshield::Settings& settings, const Image& radiance, const parallel::Executor& executor);

}  // namespace rainref::truth
