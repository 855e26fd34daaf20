// windshield.blur_pyramid, corrected. The scene in fog, and blurred levels of it; one run a level.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "blur_pyramid.glsl"

vec4 three(vec4 a, vec4 b, vec4 c, float middle, float last) { return (a + middle * (b - a)) + last * (c - a); }

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(level))) return;
  if (u.level == 0) {
    imageStore(level, texel, fogged(texel));
    return;
  }
  vec2 last = u.last * (vec2(texel) + 1.0);
  vec4 columns[3];
  for (int i = 0; i < 3; ++i) columns[i] = three(tap(texel, i, 0), tap(texel, i, 1), tap(texel, i, 2), u.middle.y, last.y);
  vec4 blurred = three(columns[0], columns[1], columns[2], u.middle.x, last.x);
  imageStore(level, texel, blurred);
}
