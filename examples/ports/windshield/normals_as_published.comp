// windshield.normals, as-published. The normal of the water in axes of the glass, z outward.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "normals.glsl"

float tap(ivec2 at) { return height_at(at) * dry_at(at); }

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (outside(at, imageSize(normals))) return;
  vec2 across = vec2(tap(at + ivec2(1, 0)) - tap(at - ivec2(1, 0)), tap(at + ivec2(0, 1)) - tap(at - ivec2(0, 1)));
  store_normal(at, across, 1.0);
}
