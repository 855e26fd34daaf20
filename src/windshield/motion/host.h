// Uniforms of windshield_frame and wipe_drops, computed on the host in double, each rounded once.
#pragma once

#include "windshield/motion/uniforms.h"
#include "windshield/motion/vehicle.h"
#include "windshield/motion/wipers.h"

namespace rainref::windshield {

/// wind [m/s] in world axes; gravity [m/s^2].
WindshieldFrameUniforms windshield_frame_uniforms(const Glass& glass, const VehicleState& vehicle, const Real3& wind, double gravity,
                                                  bool corrected);

/// How a blade of the published variant moves drops in one frame.
struct Capture {
  double follow = 0.6, inherit = 0.5, gain = 0.02;
};
constexpr int film_bins = 64;  ///< for a blade, about 1 cm each

/// radius_scale [m]: base radius of a drop of one mass unit, corrected. columns and rows: of the film; 0 without a film.
WipeDropsUniforms wipe_drops_uniforms(const Glass& glass, bool corrected, int wiper_count, const Capture& capture, double radius_scale,
                                      int columns, int rows);

}  // namespace rainref::windshield
