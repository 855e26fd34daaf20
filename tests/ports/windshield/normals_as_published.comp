#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "normals.glsl"

float tap(ivec2 at, ivec2 centre) { return height_at(at) * dry_at(BUG == 1562 ? centre : at); }

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (outside(at, imageSize(normals))) return;
  vec2 across = vec2(tap(at + ivec2(1, 0), at) - tap(at - ivec2(1, 0), at), tap(at + ivec2(0, 1), at) - tap(at - ivec2(0, 1), at));
  if (BUG == 1565) across = 2.0 * vec2(tap(at + ivec2(1, 0), at) - tap(at, at), tap(at + ivec2(0, 1), at) - tap(at, at));
  store_normal(at, across, 1.0);
}
