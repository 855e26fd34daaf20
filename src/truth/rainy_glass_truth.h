// What pass rain_on_glass makes of wet glass against what rays make of it.
#pragma once

#include "truth/rainy_glass_view.h"
#include "truth/pixels.h"

namespace rainref::truth {

/// `rendered` has rendered a frame. Compared where the picture looks through the glass; a pixel is wet where both the pass and the ray
/// through its centre find water there.
///   pixels       pixels; glass_pixels; wet_pixels, wet_in_pass_only, wet_in_truth_only; mirrored_pixels: wet ones whose ray meets the
///                water's surface beyond the critical angle
///   refraction [deg]        wet, not mirrored: between the place in the street that the pass shows and the one that the refracted
///                           ray meets, as the eye sees them
///   bend [deg]              there: how much further from the view ray the pass's place lies than the ray's
///   colour, colour_dry      linear radiance, the channel that differs most: wet; neither wet
///   display                 on the glass: code values of 255, the channel that differs most
/// Refraction by the ray through the pixel's centre, colours by options.samples rays.
Comparison compare(const rainy_glass::RainyGlass& rendered, const RainyGlassView& view, const PictureOptions& options,
                   const parallel::Executor& executor);

}  // namespace rainref::truth
