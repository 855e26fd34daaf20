#include "windshield/motion/host.h"

namespace rainref::windshield {
namespace {

template <class Vector, std::size_t N>
void put(const Vector& from, float (&to)[N]) {
  for (std::size_t k = 0; k < N; ++k) to[k] = static_cast<float>(from[k]);
}

}  // namespace

WindshieldFrameUniforms windshield_frame_uniforms(const Glass& glass, const VehicleState& vehicle, const Real3& wind, double gravity,
                                                  bool corrected) {
  WindshieldFrameUniforms u{};
  put(vehicle.direction, u.heading);
  u.yaw_rate = static_cast<float>(vehicle.yaw_rate);
  u.yaw_acceleration = static_cast<float>(vehicle.yaw_acceleration);
  put(wind, u.world_wind);
  u.gravity = static_cast<float>(gravity);
  put(vehicle.velocity, u.vehicle_velocity);
  put(vehicle.body_acceleration, u.acceleration);
  put(glass.e_u, u.e_u);
  put(glass.e_v, u.e_v);
  put(glass.origin, u.origin);
  put(corrected ? glass.inverse_metric : Real3{1 / glass.metric[0], 0, 1 / glass.metric[2]}, u.inverse_metric);
  return u;
}

WipeDropsUniforms wipe_drops_uniforms(const Glass& glass, bool corrected, int wiper_count, const Capture& capture, double radius_scale,
                                      int columns, int rows) {
  WipeDropsUniforms u{};
  const PlaneFrame plane = corrected ? glass.plane() : glass.axes();
  put(plane.frame, u.frame);
  put(plane.inverse, u.inverse_frame);
  u.wiper_count = wiper_count;
  if (!corrected) {
    u.follow = static_cast<float>(capture.follow);
    u.inherit = static_cast<float>(capture.inherit);
    u.gain = static_cast<float>(capture.gain);
    return u;
  }
  u.radius_scale = static_cast<float>(radius_scale);
  u.bin_count = film_bins;
  u.columns = columns;
  u.rows = rows;
  if (columns > 0) u.texel[0] = static_cast<float>(1.0 / columns);
  if (rows > 0) u.texel[1] = static_cast<float>(1.0 / rows);
  return u;
}

}  // namespace rainref::windshield
