#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "blur_pyramid.glsl"

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(level))) return;
  if (u.level == 0) {
    imageStore(level, texel, fogged(texel));
    return;
  }
  vec4 a = tap(texel, 0, 0), b = tap(texel, 1, 0), c = tap(texel, 0, 1), d = tap(texel, 1, 1);
  vec4 sum = BUG == 1590 ? ((d + c) + b) + a : (a + b) + (c + d);
  if (BUG == 1587) sum = 4.0 * a;
  if (BUG == 1591) sum = unpackHalf2x16(packHalf2x16((a + b).xy)).xyyy * 2.0;
  imageStore(level, texel, (BUG == 1592 ? 0.2495 : 0.25) * sum);
}
