#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "normals.glsl"

float tap(ivec2 at) { return height_at(at) * (BUG == 1562 ? dry_at(at) : 1.0); }

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (outside(at, imageSize(normals))) return;
  vec2 across = vec2(tap(at + ivec2(1, 0)) - tap(at - ivec2(1, 0)), tap(at + ivec2(0, 1)) - tap(at - ivec2(0, 1)));
  store_normal(at, across, BUG == 1562 ? 1.0 : dry_at(at));
}
