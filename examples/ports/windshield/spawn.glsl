// Both variants of spawn: the drops of before and the step's arrivals.
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

#include "random.glsl"
float uniform_number(uint word) { return float(word >> 8) / 16777216.0; }

uint above(uint word);  // thresholds that the word is not below

void main() {
  uint worker = gl_LocalInvocationIndex;
  if (worker == 0u) {
    count = 0u;
    arrivals = 0u;
    for (uint part = 0u; part < u.parts; ++part) arrivals += uint(u.first_count) + above(random_block(5u, u.step, part).x);
    arrivals = min(arrivals, u.room);
  }
  memoryBarrierBuffer();
  barrier();
  for (uint i = worker; i < drops.length(); i += workers) {
    if (drops[i].life > 0.0) append(drops[i]);
  }
  for (uint i = worker; i < arrivals; i += workers) {
    uvec4 r = random_block(6u, u.step, i);
    vec2 place = vec2(uniform_number(r.x), uniform_number(r.y));
    uint id = u.first_id + i;
    append(Drop(place, vec2(0.0), masses[r.z >> 22], u.life, id, 0.0));
  }
}
