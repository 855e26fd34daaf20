// puddle.wave_step, corrected. The next level of the water from the newest and the previous one.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform WaveStepUniforms {
  float damping;      //   0  [1] as-published: factor of the new level; corrected: gamma of a step.
  float step;         //   4  [texel] as-published: offset of the neighbours.
  float courant_sq;   //   8  [1] corrected: Courant number squared, times (1 + gamma) / 2.
  int drop_count;     //  12  [1] Drops in the list.
  float rest;         //  16  [1] Stored value of level water.
  float rim_damping;  //  20  [1] corrected: share of the wave that the rim takes at the edge itself.
  float rim_inverse;  //  24  [1/texel] corrected: one over the width of the rim.
  float padding_0;    //  28  padding
  vec2 size;          //  32  [texel] corrected: columns and rows of the wave.
  float padding_1;    //  40  padding
  float padding_2;    //  44  padding
} u;
struct Drop {
  float x;          //   0  [texel] Centre; texel centres lie at k + 1/2.
  float y;          //   4  [texel] Centre.
  float amplitude;  //   8  [1] as-published: strength times activation; corrected: stored height at the centre.
  float radius;     //  12  [texel] Nothing is added from this distance on.
};
layout(binding = 1) uniform sampler2D wave;
layout(std430, binding = 2) readonly buffer DropBuffer { Drop drops[]; };
layout(binding = 3) uniform sampler2D shore;
layout(binding = 4) uniform writeonly image2D next_wave;

layout(constant_id = 1) const int ADDRESS = CLAMP;
layout(constant_id = 2) const bool HAS_SHORE = false;
#include "wave_texel.glsl"

// The crater of a drop: (1 - q^2)^2 (1 - 4 q^2) for q = r / R < 1.
float crater(Drop drop, vec2 here) {
  vec2 offset = here - vec2(drop.x, drop.y);
  float inverse = 1.0 / drop.radius;
  vec2 scaled = offset * inverse;
  float q2 = dot(scaled, scaled);
  float rim = max(1.0 - q2, 0.0);
  return drop.amplitude * (rim * rim * (1.0 - 4.0 * q2));
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(wave, 0);
  if (outside(texel, size)) return;

  vec2 stored = wave_texel(texel);
  float newest = stored.x, previous = stored.y;
  float left = wave_texel(texel - ivec2(1, 0)).x, right = wave_texel(texel + ivec2(1, 0)).x;
  float down = wave_texel(texel - ivec2(0, 1)).x, up = wave_texel(texel + ivec2(0, 1)).x;
  float around = left + right + down + up;
  float laplacian = around - 4.0 * newest;

  // A rim along the edges swallows waves: it takes its share of both levels.
  vec2 here = vec2(texel) + 0.5;
  float rim = 1.0;
  if (u.rim_damping > 0.0) {
    vec2 edge = min(here, u.size - here);
    float depth = max(1.0 - u.rim_inverse * min(edge.x, edge.y), 0.0);
    rim = 1.0 - u.rim_damping * (depth * depth);
    previous = u.rest + rim * (previous - u.rest);
  }

  float gamma = u.damping;
  float craters = 0.0;
  for (int i = 0; i < u.drop_count; ++i) craters += crater(drops[i], here);

  float next = newest + gamma * (newest - previous) + u.courant_sq * laplacian + craters;
  float kept = 1.0;
  if (HAS_SHORE) kept = texelFetch(shore, texel, 0).x;
  if (HAS_SHORE || u.rim_damping > 0.0) next = u.rest + kept * rim * (next - u.rest);
  imageStore(next_wave, texel, vec4(next, newest + kept * craters, 0.0, 0.0));
}
