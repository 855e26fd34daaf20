// Uniform blocks of windshield_frame and wipe_drops; the record Wiper is in windshield/uniforms.h.
#pragma once

#include <cstdint>

namespace rainref::windshield {

/// In world axes x and y are level and z is up; car axes: x forward, y left, z up.
struct WindshieldFrameUniforms {
  float heading[2], yaw_rate, yaw_acceleration;
  float world_wind[3], gravity;
  float vehicle_velocity[3], padding0;
  float acceleration[3], padding1;
  float e_u[3], padding2;
  float e_v[3], padding3;
  float origin[3], padding4;
  float inverse_metric[3], padding5;
};

struct WipeDropsUniforms {
  float frame[3], follow;
  float inverse_frame[3], inherit;
  float gain, radius_scale;
  std::int32_t wiper_count, bin_count;
  float texel[2];
  std::int32_t columns, rows;
};

static_assert(sizeof(WindshieldFrameUniforms) == 128 && sizeof(WipeDropsUniforms) == 64);

}  // namespace rainref::windshield
