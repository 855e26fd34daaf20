// windshield.windshield_frame, corrected. Gravity, apparent wind and inertia in glass coordinates.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "windshield_frame.glsl"

vec2 project(vec3 f) {
  vec2 along = vec2(dot(f, u.e_u), dot(f, u.e_v));
  float mixed = u.inverse_metric.y;
  return vec2(u.inverse_metric.x * along.x + mixed * along.y, mixed * along.x + u.inverse_metric.z * along.y);
}
// -alpha x p - w x (w x p) and -2 w x v, with w = (0, 0, yaw rate)
vec3 spin_force(vec3 p) {
  float rate_sq = u.yaw_rate * u.yaw_rate, alpha = u.yaw_acceleration;
  return vec3(alpha * p.y + rate_sq * p.x, rate_sq * p.y - alpha * p.x, 0.0);
}
vec3 coriolis_force(vec3 v) {
  float twice = 2.0 * u.yaw_rate;
  return vec3(twice * v.y, -(twice * v.x), 0.0);
}
vec4 rows(vec2 of_u, vec2 of_v) { return vec4(of_u.x, of_v.x, of_u.y, of_v.y); }

void main() {
  vec3 a = u.acceleration;
  vec3 still = vec3(-a.x, -a.y, -(u.gravity + a.z));
  give(project(still + spin_force(u.origin)), project(apparent_wind()), vec2(0.0),
       rows(project(spin_force(u.e_u)), project(spin_force(u.e_v))),
       rows(project(coriolis_force(u.e_u)), project(coriolis_force(u.e_v))));
}
