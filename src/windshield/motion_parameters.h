// The scene parameters of glass, vehicle and wipers: declared once, for scenes, help, hashing and capture.
#pragma once

#include <array>
#include <vector>

#include "scene/config.h"
#include "windshield/motion_host.h"

namespace rainref::windshield {

/// windshield.corner_*, vehicle.*, world.*, wipers.*
std::vector<scene::Parameter> motion_parameters();

/// What these parameters say, checked. With vehicle(), wipers_between() and the uniforms of motion_host.h it is all
/// that the two passes take.
struct MotionSettings {
  Glass glass;
  VehicleSettings vehicle;
  WiperSettings wipers;
  Capture capture;  ///< as-published
  Real3 wind;       ///< world axes [m/s]
  double gravity;   ///< [m/s^2]
};
/// Throws Error(usage) as make_glass and check do. The path of a drive cycle that the scene file gives is taken from
/// the file's folder.
MotionSettings motion_settings_from(const scene::Config& config);

}  // namespace rainref::windshield
