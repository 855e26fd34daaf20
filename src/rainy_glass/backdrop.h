// The scene behind the glass if the user gives no picture: a street or a panorama, behind the glazing bars of a conservatory.
#pragma once

#include "rainref/rainy_glass.h"
#include "scene/scenery.h"

namespace rainref::rainy_glass {

struct BackdropOptions {
  double defocus = 0.012;    ///< distance of the glazing bars, which stand before a pane [m]; 0: none
  double bar_spacing = 0.6;  ///< between glazing bars, which stand before a pane [m]; 0: none
  double bar_width = 0.04;   ///< [m]
};

/// Colour (rgba32f) and depth of the street in the camera of `settings`, and the probe. The bits are the same on every machine.
Surroundings make_backdrop(const Settings& settings, const BackdropOptions& options, const scene::Scenery& street,
                           const parallel::Executor& executor);
/// The same for a panorama (scene/panorama_view.h), at the depth of the sky, which is also the probe.
Surroundings make_backdrop(const Settings& settings, const BackdropOptions& options, const Image& panorama,
                           const parallel::Executor& executor);
constexpr double backdrop_far = 1000;  ///< depth of the sky [m]

/// Replaces each texel by the mean of the texels whose centres are within `radius` texels; edges repeat. rgba32f.
Image defocused(const Image& image, double radius, const parallel::Executor& executor);

}  // namespace rainref::rainy_glass
