// Physics of a sessile drop on glass, in SI units and double: the constants behind the corrected passes.
#pragma once

#include "math/constants.h"
#include "math/real64.h"

namespace rainref::drops {

/// x^y for x above 0, by rainref's own functions.
inline double power(double x, double y) { return pow_real(Real64(x), Real64(y)).v; }

// Water and air at 20 degrees Celsius.
constexpr double water_density = 998.2;        // kg/m^3
constexpr double water_viscosity = 1.002e-3;   // Pa s
constexpr double surface_tension = 0.0728;     // N/m
constexpr double air_density = 1.204;          // kg/m^3
constexpr double vapour_diffusivity = 2.4e-5;  // m^2/s
constexpr double saturation_vapour = 17.3e-3;  // kg/m^3
/// Retention force = this * surface tension * width * (cos receding - cos advancing): 24 / pi^3 of A. I. ElSherbini and
/// A. M. Jacobi (J. Colloid Interface Sci. 299, 2006), for C. G. Furmidge's balance (J. Colloid Sci. 17, 1962).
constexpr double retention = 24 / (pi * pi * pi);

/// Base radius divided by the cube root of the volume of a spherical cap with this contact angle [rad], in (0, pi):
/// V = pi a^3 (2 + c) (1 - c)^2 / (3 sin^3), c the cosine.
double cap_radius_over_root(double angle);
/// Area that a cap presents to a wind along the glass, divided by its base radius squared: (angle - sin cos) / sin^2.
double cap_front_over_radius_sq(double angle);

/// Contact angles [rad] and other properties that determine how a drop holds.
struct Wetting {
  double advancing, receding;
  double mean() const { return (advancing + receding) / 2; }
};
/// Acceleration [m/s^2] along the glass that a drop of this volume [m^3] withstands; its base radius is that of the mean angle.
double held_acceleration(double volume, const Wetting& wetting);
/// Diameter [m] of the falling drop that just slides at this acceleration [m/s^2]; smaller ones stay.
double critical_diameter(double acceleration, const Wetting& wetting);
/// Acceleration [m/s^2] of a sessile drop of this volume by a local wind [m/s] along the glass, with drag coefficient `drag_coefficient`:
/// (rho_air / 2) C_D front U^2 divided by its mass.
double wind_acceleration(double volume, double angle, double drag_coefficient, double wind);
/// Rate [1/s] at which a drop approaches its final speed: U = (K / mu) rho V^(2/3) (a - a_held), the linear law between capillary and Bond
/// number of T. Podgorski, J.-M. Flesselles and L. Limat (Phys. Rev. Lett. 87, 2001); K is measured.
double sliding_drag(double volume, double mobility);
/// Loss by evaporation [kg/s] of a pinned cap of this base radius [m] into still air of this relative humidity:
/// pi a D (1 - RH) c (0.27 angle^2 + 1.30) (H. Hu and R. G. Larson, J. Phys. Chem. B 106, 2002).
double evaporation_rate(double base_radius, double angle, double humidity);

}  // namespace rainref::drops
