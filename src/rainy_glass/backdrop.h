// A scene to see through the glass where a user brings no picture: a street or a panorama, behind the glazing bars of a conservatory.
#pragma once

#include "rainref/rainy_glass.h"
#include "scene/scenery.h"

namespace rainref::rainy_glass {

struct BackdropOptions {
  double defocus = 0.012;    ///< radius of a far point's disc in a camera that focuses on the glass [picture heights]
  double bar_spacing = 0.6;  ///< between glazing bars, which stand before a pane [m]; 0: none
  double bar_width = 0.04;   ///< [m]
};

/// Colour (rgba32f) and depth of the street in the camera of `settings`, and the probe. The same bits on every machine.
Surroundings make_backdrop(const Settings& settings, const BackdropOptions& options, const scene::Scenery& street,
                           const parallel::Executor& executor);
/// The same of a panorama (scene/panorama_view.h), which is as far as the sky and the probe too.
Surroundings make_backdrop(const Settings& settings, const BackdropOptions& options, const Image& panorama,
                           const parallel::Executor& executor);
constexpr double backdrop_far = 1000;  ///< depth of the sky [m]

/// Each texel the mean of those within `radius` texels, by centres; edges repeat. rgba32f.
Image defocused(const Image& image, double radius, const parallel::Executor& executor);

}  // namespace rainref::rainy_glass
