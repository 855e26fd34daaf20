// windshield.blur_pyramid, as-published. The scene in fog, and blurred levels of it; one run a level.
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
  vec4 sum = (a + b) + (c + d);
  imageStore(level, texel, 0.25 * sum);
}
