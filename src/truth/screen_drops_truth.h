// What pass drops makes of the water on a window against what rays make of it.
#pragma once

#include "truth/screen_drops_view.h"
#include "truth/pixels.h"

namespace rainref::truth {

/// `rendered` has rendered a frame. A pixel is a drop's where the pass shows half of it or more as water, and wet where the ray
/// through its centre meets water.
///   pixels       pixels, drop_pixels, wet_pixels, drop_not_wet, wet_not_drop; mirrored_pixels and mirrored_in_pass: of those that are
///                both, where the ray, or the pass's, meets the water's surface beyond the critical angle
///   refraction [deg]       drop and wet, neither mirrored: between the directions in which the two see the scene
///   colour, colour_dry     linear radiance, the channel that differs most: drop and wet; neither
///   display                everywhere: code values of 255, the channel that differs most
/// Refraction by the ray through the pixel's centre, colours by options.samples rays.
Comparison compare(const screen_drops::ScreenDrops& rendered, const ScreenDropsView& view, const PictureOptions& options,
                   const parallel::Executor& executor);

}  // namespace rainref::truth
