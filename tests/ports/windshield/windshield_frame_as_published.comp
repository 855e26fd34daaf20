#version 450
#extension GL_GOOGLE_include_directive : enable
#include "windshield_frame.glsl"

vec2 project(vec3 f) {
  vec2 scale = BUG == 1104 ? sqrt(u.inverse_metric.xz) : u.inverse_metric.xz;
  return vec2(dot(f, u.e_u), dot(f, BUG == 1105 ? u.e_u : u.e_v)) * scale;
}

void main() {
  vec3 gravity = vec3(0.0, 0.0, BUG == 1106 ? u.gravity : -u.gravity);
  give(project(gravity), project(apparent_wind()), project(u.acceleration), vec4(0.0), vec4(0.0));
}
