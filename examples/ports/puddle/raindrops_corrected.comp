// puddle.raindrops, corrected. The drops that fall in this step.
#version 450
#extension GL_GOOGLE_include_directive : enable
// One invocation draws the drops of a step, because their order is part of the result.
layout(local_size_x = 1) in;

layout(std140, binding = 0) uniform RainfallUniforms {
  uvec2 seed;            //   0  [1] Low and high word of the seed.
  uint step;             //   8  [1] Wave steps made before this one, modulo 2^32.
  int first_count;       //  12  [1] Drops where the word is below every threshold.
  uint columns;          //  16  [texel] Columns of the wave.
  uint rows;             //  20  [texel] Rows of the wave.
  int boundary;          //  24  [1] 0: reflecting, 1: periodic, 2: fixed.
  int threshold_count;   //  28  [1] Thresholds in the list.
  uint shelter_columns;  //  32  [1] Columns of the shelter; 0: there is none.
  uint shelter_rows;     //  36  [1] Its rows.
  int object_count;      //  40  [1] Records of objects in the list.
  float padding_0;       //  44  padding
} u;
struct Drop {
  float x;          //   0  [texel] Centre; texel centres lie at k + 1/2.
  float y;          //   4  [texel] Centre.
  float amplitude;  //   8  [1] as-published: strength times activation; corrected: stored height at the centre.
  float radius;     //  12  [texel] Nothing is added from this distance on.
};
layout(std430, binding = 1) readonly buffer CraterBuffer { Drop craters[]; };
layout(std430, binding = 2) readonly buffer CountThresholdBuffer { uint thresholds[]; };
layout(std430, binding = 3) readonly buffer ShelterBuffer { uint open[]; };
layout(std430, binding = 4) readonly buffer ObjectBuffer { Drop objects[]; };
layout(std430, binding = 5) buffer DropBuffer {
  uint count;
  uint padding[3];
  Drop drops[];
};

#include "random.glsl"

// The buffer may be too short for a wrong port; the count says so.
void append(Drop drop) {
  if (count < drops.length()) drops[count] = drop;
  ++count;
}
// Only the images of a crater that reach into the rectangle count.
bool reaches(float at, float radius, uint size) { return at + radius > 0.0 && at - radius < float(size); }
// Whether no roof keeps the drop of these words off.
bool falls(uvec4 r) {
  if (u.shelter_columns == 0u) return true;
  uint column = ((r.x >> 16) * u.shelter_columns) >> 16, row = ((r.y >> 16) * u.shelter_rows) >> 16;
  return (r.w >> 16) < open[row * u.shelter_columns + column];
}

void main() {
  uint word = random_block(1u, u.step, 0u).x;
  int drawn = u.first_count;
  for (int i = 0; i < u.threshold_count; ++i) {
    if (word >= thresholds[i]) ++drawn;
  }

  count = 0u;
  for (int i = 0; i < drawn; ++i) {
    uvec4 r = random_block(2u, u.step, uint(i));
    Drop drop = craters[r.z >> 22];
    drop.x = float(((r.x >> 16) * u.columns) >> 8) / 256.0;
    drop.y = float(((r.y >> 16) * u.rows) >> 8) / 256.0;
    if (!falls(r)) continue;
    append(drop);
    if (u.boundary == 2) continue;
    vec2 size = vec2(u.columns, u.rows), place = vec2(drop.x, drop.y);
    vec2 below = u.boundary == 1 ? place - size : -place, above = u.boundary == 1 ? place + size : 2.0 * size - place;
    float xs[3] = float[3](place.x, below.x, above.x), ys[3] = float[3](place.y, below.y, above.y);
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) {
        if (j == 0 && k == 0) continue;
        if (reaches(xs[k], drop.radius, u.columns) && reaches(ys[j], drop.radius, u.rows))
          append(Drop(xs[k], ys[j], drop.amplitude, drop.radius));
      }
    }
  }
  for (int i = 0; i < u.object_count; ++i) append(objects[i]);
}
