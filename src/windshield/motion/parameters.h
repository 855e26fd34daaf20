// The scene parameters of glass, vehicle and wipers, declared once for scenes, help, hashing and capture.
#pragma once

#include <string>
#include <vector>

#include "math/constants.h"
#include "scene/config.h"
#include "windshield/motion/host.h"
#include "windshield/motion/weather.h"

namespace rainref::windshield {

/// Settings of the blades of one pane.
struct PaneWipers {
  WiperSettings wipers;
  Capture capture;  ///< as-published
};

/// Number of panes behind the windshield that may have wipers: the first ones of windshield.panes.
constexpr int most_wiped_panes = 2;

/// Name of the table for pane `number`: "wipers" for the windshield, number 0, "pane_1_wipers" for the first of the others.
std::string wiper_table(int number);

/// The keys of that table. The windshield has two blades by default, another pane none; all other defaults are equal.
std::vector<scene::Parameter> wiper_parameters(int number);

/// The checked settings for this pane. Throws Error(usage) as check and WiperMotion do.
PaneWipers wipers_from(const scene::Config& config, int number, const Glass& glass);

/// Throws Error(usage), with its place, for any key of that table in the scene.
void refuse_wipers(const scene::Config& config, int number, const std::string& why);

/// windshield.corner_*, windshield.panes, vehicle.*, world.*, rain.key_frames, rain.shelter, wipers.* and pane_1_wipers.* on
std::vector<scene::Parameter> motion_parameters();

/// The checked settings of these parameters. With vehicle(), wipers_between() and the uniforms of host.h they determine all inputs of the
/// two passes.
struct MotionSettings : PaneWipers {
  Corners corners{{{1.9, 0.7, 1.0}, {1.9, -0.7, 1.0}, {1.18719478064930573, 0.7, 1.36319239979163742}}};
  Glass glass;                 ///< of these corners
  std::vector<Corners> panes;  ///< the other panes of the car
  VehicleSettings vehicle;
  std::vector<PaneWipers> pane_wipers;  ///< for each of them; those of the windshield are this struct's own
  WeatherSettings weather;              ///< without the rain's rate, which drops::Settings has
  double gravity = standard_gravity;    ///< [m/s^2]
};
/// Throws Error(usage) as make_glass and check do. The path of a drive cycle in the scene file is relative to the file's folder.
MotionSettings motion_settings_from(const scene::Config& config);

}  // namespace rainref::windshield
