// Settings of the drops and their parameters. Each effect adds its own prefix to the keys.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/config.h"
#include "scene/parameter.h"

namespace rainref::drops {

/// Lengths in m, times in s, angles in degrees.
struct Settings {
  bool corrected = true;
  std::uint64_t seed = 0;
  std::int64_t capacity = 100000;
  double lifetime = 600;
  // as-published
  double spawn_rate = 400;  ///< [1/s]
  double mass_min = 0.4, mass_max = 1.6;
  double inertia_coupling = 1, wind_coupling = 0.33, drag = 12;
  // corrected
  double rain_rate = 5;        ///< [mm/h]
  double smallest_drop = 0.5;  ///< diameter [mm]
  double advancing_deg = 50, receding_deg = 20;
  double wind_exposure = 0.4, wind_drag = 1;
  double mobility = 0.01;
  double humidity = 0.95;
  double margin = 0.02;
  double trail_thickness = 2e-6;  ///< [m]
  double film_drying = 1e-7;      ///< [m/s]
  double neck_time = 0;           ///< merged drops: time in which their outline approaches a circle by 1 - 1/e; 0: at once [s]
};

/// The parameters: keys prefix.capacity, prefix.lifetime, …, and for corrected rain.rate and rain.smallest_drop.
std::vector<scene::Parameter> parameters(const std::string& prefix);
/// The parameters of a glass without wind along it, for an effect whose as-published variant has no such drops: corrected only.
std::vector<scene::Parameter> still_parameters(const std::string& prefix);
/// Only the corrected part of these.
std::vector<scene::Parameter> corrected_only(std::vector<scene::Parameter> parameters);
/// The settings of a scene whose effect has these parameters. Throws Error(usage) with the keys if two of them contradict each other or the
/// step is unstable.
Settings settings_from(const scene::Config& config, const std::string& prefix);
/// The same with still_parameters, for a scene whose variant is corrected.
Settings still_settings_from(const scene::Config& config, const std::string& prefix);

}  // namespace rainref::drops
