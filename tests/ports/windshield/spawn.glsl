// Both variants of spawn: the drops of before and the step's arrivals. Seeded bugs: 1121 to 1140.
#include "drops.glsl"

layout(std140, binding = 0) uniform SpawnUniforms {
  uvec2 seed;           //   0  [1] Low and high word of the seed.
  uint step;            //   8  [1] Steps made before this one, modulo 2^32.
  uint parts;           //  12  [1] Draws that add up to the count.
  int first_count;      //  16  [1] Drops of a draw whose word is below every threshold.
  int threshold_count;  //  20  [1] Thresholds in the list; 0: each draw gives first_count.
  uint first_id;        //  24  [1] Id of the first arrival; the others follow.
  uint room;            //  28  [1] Free slots: arrivals beyond are lost.
  float life;           //  32  [s] Life of a new drop.
  float padding_0;      //  36  padding
  float padding_1;      //  40  padding
  float padding_2;      //  44  padding
} u;
layout(std430, binding = DROPS_OUT - 1) readonly buffer SpawnMassBuffer { float masses[]; };
shared uint arrivals;

uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}
uvec4 random_block(uint purpose, uint a, uint b) {
  uvec4 key = pcg4d(uvec4(BUG == 1121 ? u.seed.yx : u.seed, purpose, 0u));
  return pcg4d(uvec4(a ^ key.x, b ^ key.y, key.zw));
}
float uniform_number(uint word) { return BUG == 1122 ? float(word) / 4294967296.0 : float(word >> 8) / 16777216.0; }

uint above(uint word);  // thresholds that the word is not below

void main() {
  uint worker = gl_LocalInvocationIndex;
  if (worker == 0u) {
    count = 0u;
    arrivals = 0u;
    for (uint part = 0u; part < u.parts; ++part) arrivals += uint(u.first_count) + above(random_block(5u, u.step, part).x);
    if (BUG != 1123) arrivals = min(arrivals, u.room);
    if (BUG == 1124) arrivals += 1u;
  }
  memoryBarrierBuffer();
  barrier();
  for (uint i = worker; i < drops.length(); i += workers) {
    if (drops[i].life > 0.0) append(drops[i]);
  }
  for (uint i = worker; i < arrivals; i += workers) {
    uvec4 r = random_block(BUG == 1125 ? 5u : 6u, u.step, BUG == 1126 ? u.first_id + i : i);
    vec2 place = vec2(uniform_number(r.x), uniform_number(r.y));
    uint id = u.first_id + (BUG == 1127 ? i + 1u : i);
    append(Drop(BUG == 1128 ? place.yx : place, vec2(0.0), masses[r.z >> (BUG == 1129 ? 23 : 22)], u.life, id, 0.0));
  }
}
