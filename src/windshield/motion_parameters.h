// The scene parameters of glass, vehicle and wipers: declared once, for scenes, help, hashing and capture.
#pragma once

#include <array>
#include <vector>

#include "math/constants.h"
#include "scene/config.h"
#include "windshield/motion_host.h"
#include "windshield/weather.h"

namespace rainref::windshield {

/// windshield.corner_*, windshield.panes, vehicle.*, world.*, wipers.*, rain.key_frames
std::vector<scene::Parameter> motion_parameters();

/// What these parameters say, checked. With vehicle(), wipers_between() and the uniforms of motion_host.h it is all
/// that the two passes take.
struct MotionSettings {
  Corners corners{{{1.9, 0.7, 1.0}, {1.9, -0.7, 1.0}, {1.18719478064930573, 0.7, 1.36319239979163742}}};
  Glass glass;                 ///< of these corners
  std::vector<Corners> panes;  ///< the car's others
  VehicleSettings vehicle;
  WiperSettings wipers;
  double fast_cycles_per_minute = 65;                     ///< where key frames say fast
  std::array<Blade, most_wipers> custom = tandem_blades;  ///< what the keys ending in _0 and _1 say
  Capture capture;                                        ///< as-published
  WeatherSettings weather;                                ///< the rain's rate aside, which drops::Settings has
  double gravity = standard_gravity;                      ///< [m/s^2]
};
/// Throws Error(usage) as make_glass and check do. The path of a drive cycle that the scene file gives is taken from
/// the file's folder.
MotionSettings motion_settings_from(const scene::Config& config);

}  // namespace rainref::windshield
