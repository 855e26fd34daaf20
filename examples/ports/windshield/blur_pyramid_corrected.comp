// windshield.blur_pyramid, corrected. The scene in fog, and blurred levels of it; one run a level.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "blur_pyramid.glsl"

vec4 mirrored(ivec2 at) {
  at = max(at, -1 - at);
  at = min(at, 2 * u.source_size - 1 - at);
  return texelFetch(above, clamp(at, ivec2(0), u.source_size - 1), 0);
}
vec4 bell(vec4 t0, vec4 t1, vec4 t2, vec4 t3, vec4 t4) { return (0.375 * t2 + 0.25 * (t1 + t3)) + 0.0625 * (t0 + t4); }
vec4 seven(vec4 t[7], float middle, float last) {
  vec4 a = bell(t[0], t[1], t[2], t[3], t[4]), b = bell(t[1], t[2], t[3], t[4], t[5]), c = bell(t[2], t[3], t[4], t[5], t[6]);
  return (a + middle * (b - a)) + last * (c - a);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(level))) return;
  if (u.level == 0) {
    imageStore(level, texel, fogged(texel));
    return;
  }
  vec2 last = u.last * (vec2(texel) + 1.0);
  vec4 columns[7];
  for (int i = 0; i < 7; ++i) {
    vec4 rows[7];
    for (int j = 0; j < 7; ++j) rows[j] = mirrored(2 * texel + ivec2(i - 2, j - 2));
    columns[i] = seven(rows, u.middle.y, last.y);
  }
  imageStore(level, texel, seven(columns, u.middle.x, last.x));
}
