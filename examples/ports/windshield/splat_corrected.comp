// windshield.splat, corrected. The height of the water: every live drop, in slot order, on the film.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "splat.glsl"
layout(binding = 2) uniform sampler2D film;
layout(std430, binding = 3) readonly buffer NeckBuffer { Neck necks[]; };
layout(binding = 4) uniform writeonly image2D heights;

Neck neck_of(uint id) {
  for (int i = 0; i < necks.length(); ++i)
    if (necks[i].id == id) return necks[i];
  return Neck(vec2(0.0), 0.0, 0.0, id, 0.0, 0.0, 0.0);
}

float quanta(ivec2 at) {
  ivec2 last = textureSize(film, 0) - 1;
  return texelFetch(film, clamp(at, ivec2(0), last), 0).x;
}
float tent(float before, float here, float after) { return 0.5 * here + 0.25 * (before + after); }
float row(ivec2 at) { return tent(quanta(at - ivec2(1, 0)), quanta(at), quanta(at + ivec2(1, 0))); }

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(heights))) return;
  float height = u.film_scale * tent(row(texel - ivec2(0, 1)), row(texel), row(texel + ivec2(0, 1)));
  imageStore(heights, texel, vec4(height + blended(texel), 0.0, 0.0, 0.0));
}
