// Uniform blocks of windshield_frame and wipe_drops; the record Wiper lies in windshield/uniforms.h.
#pragma once

#include <cstdint>

namespace rainref::windshield {

/// World axes are level and z up; car axes: x forward, y left, z up.
struct WindshieldFrameUniforms {
  float heading[2];           ///< cosine and sine of the car's heading
  float yaw_rate;             ///< positive to the left [rad/s]
  float yaw_acceleration;     ///< [rad/s^2]
  float world_wind[3];        ///< world axes [m/s]
  float gravity;              ///< [m/s^2]
  float vehicle_velocity[3];  ///< world axes [m/s]
  float padding0;
  float acceleration[3];  ///< of the car's origin, car axes [m/s^2]
  float padding1;
  float e_u[3];  ///< car axes [m]
  float padding2;
  float e_v[3];
  float padding3;
  float origin[3];  ///< the glass's corner (0, 0), car axes [m]
  float padding4;
  float inverse_metric[3];  ///< corrected: uu, uv, vv of the inverse of the metric; as-published: 1/|e_u|^2, 0,
                            ///< 1/|e_v|^2 [1/m^2]
  float padding5;
};

struct WipeDropsUniforms {
  float frame[3];              ///< x = f0 u + f1 v, y = f2 v: plane coordinates [m] of glass coordinates
  float follow;                ///< as-published: share of the way to the leading edge in a frame
  float inverse_frame[3];      ///< u = i0 x + i1 y, v = i2 y
  float inherit;               ///< as-published: share of the blade's velocity in a frame
  float gain;                  ///< as-published: mass gained in a frame
  float radius_scale;          ///< corrected: base radius of a drop of one mass unit [m]
  std::int32_t wiper_count;    ///< records in the list
  std::int32_t bin_count;      ///< corrected: radial bins that share out the film
  float texel[2];              ///< corrected: 1 / columns and rows of the film
  std::int32_t columns, rows;  ///< corrected: of the film
};

static_assert(sizeof(WindshieldFrameUniforms) == 128 && sizeof(WipeDropsUniforms) == 64);

}  // namespace rainref::windshield
