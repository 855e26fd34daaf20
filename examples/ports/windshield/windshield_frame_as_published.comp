// windshield.windshield_frame, as-published. Gravity, apparent wind and inertia in glass coordinates.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "windshield_frame.glsl"

vec2 project(vec3 f) {
  return vec2(dot(f, u.e_u), dot(f, u.e_v)) * u.inverse_metric.xz;
}

void main() {
  vec3 gravity = vec3(0.0, 0.0, -u.gravity);
  give(project(gravity), project(apparent_wind()), project(u.acceleration), vec4(0.0), vec4(0.0));
}
