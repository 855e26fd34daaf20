// windshield.necks, corrected. Outlines of drops that become one stay, with a neck, and recede.
#version 450
#extension GL_GOOGLE_include_directive : enable
// Plain, not fast: every pair is tested. A list without records is bound as one of zeros, of which nothing is left.
const uint workers = 64;
layout(local_size_x = 64) in;
#include "neck.glsl"

layout(std140, binding = 0) uniform NecksUniforms {
  vec3 frame;       //   0  [m] As in IntegrateUniforms.
  float radius;     //  12  [m] Base radius over mass^(1/3).
  float dt;         //  16  [s] The step.
  float keep;       //  20  [1] What a step leaves of a neck.
  float padding_0;  //  24  padding
  float padding_1;  //  28  padding
} u;
struct Drop {
  vec2 position;    //   0  [1] Glass coordinates u, v.
  vec2 velocity;    //   8  [1/s] Change of the position.
  float mass;       //  16  [1] as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24.
  float life;       //  20  [s] What remains; not above 0: no drop.
  uint id;          //  24  [1] Its own for ever, ascending in the order of birth.
  float padding_0;  //  28  padding
};
layout(std430, binding = 1) readonly buffer DropBuffer { Drop drops[]; };
layout(std430, binding = 2) readonly buffer NeckBuffer { Neck necks[]; };
layout(std430, binding = 3) coherent buffer GivenBuffer {
  uint count;
  uint padding[3];
  Neck given[];
};

const int none = -1;

float base_radius(float mass) { return u.radius * pow(max(mass, 1.0), 1.0 / 3.0); }
vec2 to_plane(vec2 uv) { return vec2(u.frame.x * uv.x + u.frame.y * uv.y, u.frame.z * uv.y); }
bool touching(Drop a, Drop b) {
  vec2 apart = to_plane(a.position) - to_plane(b.position);
  float reach = base_radius(a.mass) + base_radius(b.mass);
  return apart.x * apart.x + apart.y * apart.y < reach * reach;
}
bool is_larger(Drop a, Drop b) {
  return a.mass != b.mass ? a.mass > b.mass : a.id < b.id;
}
bool stands_out(Neck neck) {
  vec2 radii = footprints(neck);
  return neck.left > 1.0 / 64.0 && length(neck.offset) * neck.left + radii.y > radii.x;
}
// The largest of the drops that are larger than drop i and touch it.
int larger_of(int i) {
  int to = none;
  for (int j = 0; j < drops.length(); ++j) {
    if (j == i || drops[j].life <= 0.0 || !is_larger(drops[j], drops[i]) || !touching(drops[i], drops[j])) continue;
    if (to == none || is_larger(drops[j], drops[to])) to = j;
  }
  return to;
}
Neck joined(Drop a, Drop b) {
  float mass = a.mass + b.mass;
  return Neck(to_plane(b.position - a.position) * (1.0 / base_radius(mass)), b.mass / max(mass, 1.0), 1.0, a.id, 0.0, 0.0, 0.0);
}

void main() {
  if (gl_LocalInvocationIndex == 0u) count = 0u;
  memoryBarrierBuffer();
  barrier();
  for (int i = int(gl_LocalInvocationIndex); i < drops.length(); i += int(workers)) {
    Drop d = drops[i];
    if (d.life <= 0.0 || larger_of(i) != none) continue;
    Neck neck = Neck(vec2(0.0), 0.0, 0.0, d.id, 0.0, 0.0, 0.0);
    for (int j = 0; j < necks.length(); ++j) {
      if (necks[j].id != d.id) continue;
      neck = necks[j];
      float way = length(to_plane(d.velocity)) * u.dt;
      neck.left = max(neck.left * u.keep - way / base_radius(d.mass), 0.0);
    }
    int largest = none;
    for (int j = 0; j < drops.length(); ++j) {
      if (j == i || drops[j].life <= 0.0 || !is_larger(d, drops[j]) || !touching(d, drops[j])) continue;
      if ((largest == none || is_larger(drops[j], drops[largest])) && larger_of(j) == i) largest = j;
    }
    if (largest != none) {
      Neck fresh = joined(d, drops[largest]);
      if (stands_out(fresh) && !(neck.share * neck.left > fresh.share)) neck = fresh;
    }
    if (!stands_out(neck)) continue;
    uint at = atomicAdd(count, 1u);
    if (at < given.length()) given[at] = neck;
  }
}
