// The sky over the street and the haze in it.
#pragma once

#include "night_street/vec.h"

namespace rainref::night_street {

struct City;

/// Radiance of the haze where it hides everything: the city's glow on rain, linear.
inline constexpr Vec haze_glow{0.027, 0.0195, 0.0245};

/// Share of a surface's light that passes `distance` metres of haze: 1 at 0, decreasing toward 0.
inline double clear_share(double distance) { return 1 / (1 + distance * (1.0 / 130) + square(distance * (1.0 / 150))); }

/// Cloudless sky in direction d (unit): blue-violet overhead, glow near the horizon. For weak reflections.
Vec sky_gradient(const Vec& d);
/// Low clouds lit from below by the city.
Vec sky(const City& city, const Vec& d);
/// Height, metres, of the silhouettes at the end of the street (z sign `end`, +1 or -1) at this x.
double skyline_height(const City& city, double end, double x);
/// Their faces with a few lit windows.
Vec skyline_radiance(const City& city, double end, const Vec& point);

}  // namespace rainref::night_street
