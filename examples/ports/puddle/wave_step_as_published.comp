// puddle.wave_step, as-published. The next level of the water from the newest and the previous one.
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
layout(binding = 3) uniform writeonly image2D next_wave;

layout(constant_id = 1) const int ADDRESS = CLAMP;
#include "wave_texel.glsl"

// GLSL leaves smoothstep(4, 0.5, x) undefined; this is its formula.
float falling_smoothstep(float edge0, float edge1, float x) {
  float t = clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Newest level at an offset of `step` texels along an axis; a fraction reads between texels.
float neighbour(ivec2 texel, ivec2 axis) {
  int whole = int(u.step);
  float fraction = u.step - float(whole);
  float level = wave_texel(texel + whole * axis).x;
  return fraction == 0.0 ? level : mix(level, wave_texel(texel + (whole + 1) * axis).x, fraction);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(wave, 0);
  if (outside(texel, size)) return;

  vec2 stored = wave_texel(texel);
  float down = neighbour(texel, ivec2(0, -1)), left = neighbour(texel, ivec2(-1, 0));
  float right = neighbour(texel, ivec2(1, 0));
  float up = neighbour(texel, ivec2(0, 1));

  float previous = stored.y;
  float d = -2.0 * (previous - 0.5) + (down + left + right + up - 2.0);
  d *= u.damping;

  vec2 here = vec2(texel) + 0.5;
  for (int i = 0; i < u.drop_count; ++i) {
    if (drops[i].amplitude > 0.01) {
      vec2 centre = vec2(drops[i].x, drops[i].y);
      float r = distance(centre, here);
      float shape = falling_smoothstep(4.0, 0.5, r);
      d += drops[i].amplitude * shape;
    }
  }

  float next = 0.5 * d + 0.5;
  imageStore(next_wave, texel, vec4(next, stored.x, 0.0, 0.0));
}
