// What tests start from where a scene's defaults would be a picture: round numbers that a test's arithmetic can follow.
#pragma once

#include "rainref/edge_splash.h"
#include "rainref/puddle.h"
#include "rainref/rainy_glass.h"
#include "rainref/screen_drops.h"

namespace rainref::test {

inline puddle::Settings puddle_settings() {
  puddle::Settings s;
  s.seed = 1;
  s.rain_speed = 1;
  s.damping = 0.98;
  s.vignette = s.fog_depth = 0;
  s.ground_scale = s.water_turbidity = 1;
  s.puddle_depth = 0.05;
  s.tint = {0, 0, 0};
  s.shore_width = 0.002;
  s.ground_reach = 0;
  s.exposure = 0;
  s.rain_rate = 10;
  s.smallest_drop = 0.5;
  s.vertical_fov_deg = 45;
  return s;
}
inline edge_splash::Settings edge_splash_settings() {
  edge_splash::Settings s;
  s.seed = 1;
  s.drop_color = {1, 1, 1};
  s.drop_alpha = 1;
  s.rain_drop_scale = 0.5;
  s.exposure = 0;
  s.camera_position = {0, 0, 0};
  s.camera_target = {0, 0, -1};
  s.vertical_fov_deg = 60;
  return s;
}
inline rainy_glass::Settings rainy_glass_settings() {
  rainy_glass::Settings s;
  s.seed = 1;
  s.droplet_count = 700;
  s.trail_count = 26;
  s.largest_droplet = 0.016;
  s.smallest_droplet = 0.003;
  s.trail_half_width = 0.008;
  s.contact_angle_deg = 40;
  s.drop_tile = 0.4;
  s.rain_amount = 0.8;
  s.drop_period = 6;
  s.flow_strength = 0.02;
  s.exposure = 0;
  s.camera_position = {0, 1.6, 0};
  s.camera_target = {0, 1.6, -1};
  return s;
}
inline screen_drops::Settings screen_drops_settings() {
  screen_drops::Settings s;
  s.seed = 1;
  s.exposure = 0;
  s.camera_position = {0, 1.6, 0};
  s.camera_target = {0, 1.6, -1};
  s.vertical_fov_deg = 40;
  return s;
}

}  // namespace rainref::test
