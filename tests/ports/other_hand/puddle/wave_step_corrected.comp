// puddle.wave_step, corrected. A step of the wave in metres.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 1) const int edge_rule = 0;
layout(constant_id = 2) const int has_shore = 0;
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
layout(binding = 3) uniform sampler2D shore;
layout(binding = 4) uniform writeonly image2D wave_out;

ivec2 extent = textureSize(wave, 0);

// Both levels, newest and previous, of a place that may lie beyond the edge.
vec2 water(int column, int row) {
  ivec2 place = ivec2(column, row);
  ivec2 inside = clamp(place, ivec2(0), extent - ivec2(1));
  if (edge_rule == REPEATS) inside = place + extent * (ivec2(lessThan(place, ivec2(0))) - ivec2(greaterThanEqual(place, extent)));
  if (edge_rule == RESTS && inside != place) return vec2(given.rest);
  return texelFetch(wave, inside, 0).rg;
}
// What the drops add at a texel's centre.
float impacts(vec2 centre) {
  float total = 0.0;
  for (int k = 0; k < given.drop_count; k++) {
    vec2 place = vec2(drops[k].x, drops[k].y);
    vec2 scaled = (centre - place) * (1.0 / drops[k].radius);
    float s = scaled.x * scaled.x + scaled.y * scaled.y;
    float hill = max(1.0 - s, 0.0);
    total += drops[k].amplitude * (hill * hill * (1.0 - 4.0 * s));
  }
  return total;
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, extent))) return;
  vec2 own = water(here.x, here.y);
  precise float across = water(here.x - 1, here.y).x + water(here.x + 1, here.y).x;
  precise float along = water(here.x, here.y - 1).x + water(here.x, here.y + 1).x;
  precise float bend = (across + along) - 4.0 * own.x;

  vec2 centre = vec2(here) + 0.5;
  float kept = 1.0;
  if (given.rim_damping > 0.0) {
    vec4 margin = vec4(centre, given.size - centre);
    margin.xy = min(margin.xy, margin.zw);
    float deep = max(1.0 - given.rim_inverse * min(margin.x, margin.y), 0.0);
    kept = 1.0 - given.rim_damping * (deep * deep);
    own.y = given.rest + kept * (own.y - given.rest);
  }

  float crater = impacts(centre);
  precise float next = own.x + given.damping * (own.x - own.y);
  next = next + given.courant_sq * bend;
  next = next + crater;
  float weight = 1.0;
  if (has_shore == 1) weight = texelFetch(shore, here, 0).x;
  if (has_shore == 1 || given.rim_damping > 0.0) next = given.rest + (weight * kept) * (next - given.rest);
  imageStore(wave_out, here, vec4(next, own.x + weight * crater, 0.0, 0.0));
}
