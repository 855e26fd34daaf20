// puddle.wave_step, as-published. A step of the wave as the article makes it.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const int edge_rule = 0;
const int REPEATS = 1, RESTS = 2;

struct Drop {
  float x;          //   0  [texel] Centre; texel centres lie at k + 1/2.
  float y;          //   4  [texel] Centre.
  float amplitude;  //   8  [1] as-published: strength times activation; corrected: stored height at the centre.
  float radius;     //  12  [texel] Nothing is added from this distance on.
};

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
} given;

layout(std430, binding = 2) readonly buffer DropsBuffer { Drop drops[]; };
layout(binding = 1) uniform sampler2D wave;
layout(binding = 3) uniform writeonly image2D wave_out;

ivec2 extent = textureSize(wave, 0);

// The newest level (x) and the one before (y) of a place, which may lie beyond the edge.
vec2 levels(ivec2 place) {
  if (edge_rule == REPEATS) place = place - extent * ivec2(floor((vec2(place) + 0.5) / vec2(extent)));
  if (edge_rule == RESTS && (clamp(place, ivec2(0), extent - 1) != place)) return vec2(given.rest);
  return texelFetch(wave, clamp(place, ivec2(0), extent - 1), 0).xy;
}
// The newest level given.step texels from `here` along the unit vector `way`.
float ahead(ivec2 here, ivec2 way) {
  float whole = floor(given.step);
  float part = given.step - whole;
  float close = levels(here + way * int(whole)).x;
  if (part == 0.0) return close;
  float wide = levels(here + way * int(whole + 1.0)).x;
  return close * (1.0 - part) + wide * part;
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (here.x >= extent.x || here.y >= extent.y) return;
  vec2 own = levels(here);
  vec4 ring = vec4(ahead(here, ivec2(0, -1)), ahead(here, ivec2(-1, 0)), ahead(here, ivec2(1, 0)), ahead(here, ivec2(0, 1)));
  float push = ((ring.x + ring.y) + ring.z) + ring.w;
  push = (push - 2.0) - 2.0 * (own.y - 0.5);
  push *= given.damping;
  vec2 centre = vec2(here) + vec2(0.5);
  uint count = uint(given.drop_count);
  for (uint k = 0u; k != count; ++k) {
    if (drops[k].amplitude <= 0.01) continue;
    vec2 away = vec2(drops[k].x, drops[k].y) - centre;
    float near = clamp((4.0 - length(away)) / 3.5, 0.0, 1.0);
    push += drops[k].amplitude * (near * near * (3.0 - 2.0 * near));
  }
  imageStore(wave_out, here, vec4(0.5 + 0.5 * push, own.x, 0.0, 0.0));
}
