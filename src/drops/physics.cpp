#include "drops/physics.h"

namespace rainref::drops {
namespace {

double sine(double x) { return sin_real(Real64(x)).v; }
double cosine(double x) { return cos_real(Real64(x)).v; }
double held(const Wetting& w) { return retention * surface_tension * (cosine(w.receding) - cosine(w.advancing)); }

}  // namespace

double cap_radius_over_root(double angle) {
  const double s = sine(angle), c = cosine(angle);
  return power(3 * s * s * s / (pi * (2 + c) * (1 - c) * (1 - c)), 1.0 / 3);
}

double cap_front_over_radius_sq(double angle) {
  const double s = sine(angle);
  return (angle - s * cosine(angle)) / (s * s);
}

double held_acceleration(double volume, const Wetting& w) {
  const double width = 2 * cap_radius_over_root(w.mean()) * power(volume, 1.0 / 3);
  return held(w) * width / (water_density * volume);
}

double critical_diameter(double acceleration, const Wetting& w) {
  // held * 2 a = rho V acceleration with a ~ V^(1/3), so V^(2/3) is known.
  const double volume = power(2 * held(w) * cap_radius_over_root(w.mean()) / (water_density * acceleration), 1.5);
  return power(6 * volume / pi, 1.0 / 3);
}

double wind_acceleration(double volume, double angle, double drag_coefficient, double wind) {
  const double radius = cap_radius_over_root(angle) * power(volume, 1.0 / 3);
  return 0.5 * air_density * drag_coefficient * cap_front_over_radius_sq(angle) * radius * radius * wind * wind / (water_density * volume);
}

double sliding_drag(double volume, double mobility) { return water_viscosity / (mobility * water_density * power(volume, 2.0 / 3)); }

double evaporation_rate(double base_radius, double angle, double humidity) {
  return pi * base_radius * vapour_diffusivity * (1 - humidity) * saturation_vapour * (0.27 * angle * angle + 1.30);
}

}  // namespace rainref::drops
