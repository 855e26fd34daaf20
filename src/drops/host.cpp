#include "drops/host.h"

#include <algorithm>

#include "drops/motion/spawn.pass.h"
#include "drops/physics.h"
#include "math/constants.h"
#include "math/real64.h"
#include "rain/rain.h"
#include "random/poisson.h"

namespace rainref::drops {
namespace {

constexpr double rest_speed = 1e-6;  // m/s: a millimetre in a quarter of an hour
constexpr double golden_section = 0x1.3c6ef372fe95p-1;
constexpr int classes = static_cast<int>(arrival_classes);
constexpr int cells = 2000;  // for the integral over diameters; the corners of the table limit the error to 1e-5

double volume_of_mass_unit() { return mass_unit / water_density; }
Wetting wetting(const Settings& s) { return {s.advancing_deg * pi / 180, s.receding_deg * pi / 180}; }

std::vector<SizeCell> sizes_in_air(const Settings& s, double rate) {
  std::vector<SizeCell> out;
  if (!s.corrected || rate == 0) return out;
  const rain::DropSizes sizes(rate, s.smallest_drop);
  const double h = (rain::DropSizes::largest_mm - s.smallest_drop) / cells;
  for (int i = 0; i < cells; ++i) {
    const double d = s.smallest_drop + (i + 0.5) * h;
    out.push_back({d, sizes.number(d) * h, rain::terminal_velocity(d)});
  }
  return out;
}
/// [1/m^2/s]
double arrivals_of(const SizeCell& c, double normal_z, double normal_wind) {
  return c.number * std::max(0.0, c.fall * normal_z - normal_wind);
}
double water_mass(double diameter_mm) { return water_density * pi / 6 * diameter_mm * diameter_mm * diameter_mm * 1e-9; }
float mass_units_of(double diameter_mm) {
  // A whole number, at least 1, and exact in float.
  const double mass_units = static_cast<double>(static_cast<std::int64_t>(water_mass(diameter_mm) / mass_unit + 0.5));
  return static_cast<float>(std::clamp(mass_units, 1.0, static_cast<double>(most_mass)));
}
/// Events of a rate in step n. Exact if rate * n is, because division is correctly rounded.
std::int64_t events_in(double rate, std::int64_t n, double steps_per_second) {
  const auto until = [&](std::int64_t k) { return static_cast<std::int64_t>(rate * static_cast<double>(k) / steps_per_second); };
  return until(n + 1) - until(n);
}

void put(const PlaneFrame& from, float (&to)[3]) {
  for (std::size_t k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

}  // namespace

double radius_of_mass_unit(const Settings& s) { return cap_radius_over_root(wetting(s).mean()) * power(volume_of_mass_unit(), 1.0 / 3); }

IntegrateUniforms integrate_uniforms(const Settings& s, const PlaneFrame& frame, double dt) {
  IntegrateUniforms u{};
  u.dt = static_cast<float>(dt);
  if (!s.corrected) {
    u.inertia_coupling = static_cast<float>(s.inertia_coupling);
    u.wind_coupling = static_cast<float>(s.wind_coupling);
    u.drag = static_cast<float>(s.drag);
    return u;
  }
  put(frame, u.frame);
  // Each constant is that of a drop of one mass unit, whose cube root is 1.
  const double volume = volume_of_mass_unit(), angle = wetting(s).mean();
  u.drag = static_cast<float>(sliding_drag(volume, s.mobility));
  u.wind_push = static_cast<float>(wind_acceleration(volume, angle, s.wind_drag, s.wind_exposure));
  u.hold = static_cast<float>(held_acceleration(volume, wetting(s)));
  u.evaporation = static_cast<float>(evaporation_rate(radius_of_mass_unit(s), angle, s.humidity) / mass_unit);
  u.margin = static_cast<float>(s.margin);
  u.rest_speed = static_cast<float>(rest_speed);
  u.phase_rate = static_cast<float>(64 * golden_section / dt);
  return u;
}

MergeUniforms merge_uniforms(const Settings& s, const PlaneFrame& frame, double dt, int columns, int rows, std::int64_t drying) {
  MergeUniforms u{};
  put(frame, u.frame);
  u.radius = static_cast<float>(radius_of_mass_unit(s));
  u.trail = static_cast<float>(2 * s.trail_thickness * water_density / mass_unit);
  u.dt = static_cast<float>(dt);
  u.film[0] = columns;
  u.film[1] = rows;
  u.drying = static_cast<float>(drying);
  return u;
}

NecksUniforms necks_uniforms(const Settings& s, const PlaneFrame& frame, double dt) {
  NecksUniforms u{};
  put(frame, u.frame);
  u.radius = static_cast<float>(radius_of_mass_unit(s));
  u.dt = static_cast<float>(dt);
  u.keep = static_cast<float>(exp_real(Real64(-dt / s.neck_time)).v);
  return u;
}

std::int64_t film_loss(const Settings& s, double texel_area, std::int64_t n, double steps_per_second) {
  return std::min(events_in(s.film_drying * texel_area * water_density / mass_unit, n, steps_per_second),
                  static_cast<std::int64_t>(most_mass));
}

Flux flux(const Settings& s, double normal_z, double normal_wind) {
  Flux sum{0, 0};
  for (const SizeCell& c : sizes_in_air(s, s.rain_rate)) {
    const double arrivals = arrivals_of(c, normal_z, normal_wind);
    sum.drops += arrivals;
    sum.water += arrivals * water_mass(c.diameter);
  }
  return sum;
}

Arrivals::Arrivals(const Settings& settings)
    : settings_(settings), sizes_(sizes_in_air(settings, settings.rain_rate)), rate_(settings.rain_rate) {}

void Arrivals::make_tables(const Exposure& e, double steps_per_second) {
  if (e == made_for_ && steps_per_second == made_rate_) return;
  plan_ = {};
  const double rate = e.rain_rate < 0 ? settings_.rain_rate : e.rain_rate;
  if (rate != rate_) sizes_ = sizes_in_air(settings_, rate);
  rate_ = rate;
  if (!settings_.corrected) {
    plan_.uniforms.parts = 1;
    for (int k = 0; k < classes; ++k) {
      plan_.masses.push_back({static_cast<float>(settings_.mass_min + (settings_.mass_max - settings_.mass_min) * ((k + 0.5) / classes))});
    }
  } else {
    double total = 0;
    for (const SizeCell& c : sizes_) total += arrivals_of(c, e.normal_z, e.normal_wind);
    plan_.mean = total * e.area / steps_per_second;
    plan_.uniforms.parts = 1 + static_cast<std::uint32_t>(plan_.mean / random::PoissonTable::max_mean);
    const random::PoissonTable table(plan_.mean / plan_.uniforms.parts);
    plan_.uniforms.first_count = table.first();
    for (const std::uint32_t t : table.thresholds()) plan_.thresholds.push_back({t});
    // Class k represents the drops around the quantile (k + 1/2) / classes.
    const auto bound = [&] { return total * ((static_cast<double>(plan_.masses.size()) + 0.5) / classes); };
    double sum = 0, next = bound();
    for (const SizeCell& c : sizes_) {
      const double arrivals = arrivals_of(c, e.normal_z, e.normal_wind);
      sum += arrivals;
      for (; arrivals > 0 && static_cast<int>(plan_.masses.size()) < classes && sum >= next; next = bound())
        plan_.masses.push_back({mass_units_of(c.diameter)});
    }
    // If no drop arrives, the table is filled all the same.
    while (static_cast<int>(plan_.masses.size()) < classes)
      plan_.masses.push_back(plan_.masses.empty() ? SpawnMass{1} : plan_.masses.back());
  }
  plan_.uniforms.threshold_count = static_cast<std::int32_t>(plan_.thresholds.size());
  plan_.uniforms.seed[0] = static_cast<std::uint32_t>(settings_.seed);
  plan_.uniforms.seed[1] = static_cast<std::uint32_t>(settings_.seed >> 32);
  plan_.uniforms.life = static_cast<float>(settings_.lifetime);
  made_for_ = e;
  made_rate_ = steps_per_second;
}

const SpawnPlan& Arrivals::plan(const Exposure& exposure, std::int64_t n, double steps_per_second, std::uint32_t first_id,
                                std::int64_t room) {
  make_tables(exposure, steps_per_second);
  plan_.uniforms.step = static_cast<std::uint32_t>(n);
  plan_.uniforms.first_id = first_id;
  plan_.uniforms.room = static_cast<std::uint32_t>(room);
  if (!settings_.corrected) {
    const std::int64_t count = exposure.arrivals < 0 ? events_in(settings_.spawn_rate, n, steps_per_second) : exposure.arrivals;
    plan_.uniforms.first_count = static_cast<std::int32_t>(count);
    plan_.mean = static_cast<double>(count);
  }
  return plan_;
}

}  // namespace rainref::drops
