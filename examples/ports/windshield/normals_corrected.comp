// windshield.normals, corrected. The normal of the water in axes of the glass, z outward.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "normals.glsl"

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (outside(at, imageSize(normals))) return;
  vec2 across = vec2(height_at(at + ivec2(1, 0)) - height_at(at - ivec2(1, 0)), height_at(at + ivec2(0, 1)) - height_at(at - ivec2(0, 1)));
  store_normal(at, across, dry_at(at));
}
