// What the host computes for windshield_frame and wipe_drops: uniforms, in double, each rounded once.
#pragma once

#include "windshield/motion/uniforms.h"
#include "windshield/motion/vehicle.h"
#include "windshield/motion/wipers.h"

namespace rainref::windshield {

/// wind [m/s] in world axes; gravity [m/s^2].
WindshieldFrameUniforms windshield_frame_uniforms(const Glass& glass, const VehicleState& vehicle, const Real3& wind, double gravity,
                                                  bool corrected);

/// How a blade of the published variant takes drops along, in one frame.
struct Capture {
  double follow = 0.6, inherit = 0.5, gain = 0.02;
};
constexpr int film_bins = 64;  ///< about 1 cm of a blade each

/// radius_scale [m]: base radius of a drop of one mass unit, corrected. columns and rows: of the film; 0 without one.
WipeDropsUniforms wipe_drops_uniforms(const Glass& glass, bool corrected, int wiper_count, const Capture& capture, double radius_scale,
                                      int columns, int rows);

}  // namespace rainref::windshield
