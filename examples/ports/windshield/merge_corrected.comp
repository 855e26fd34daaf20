// windshield.merge, corrected. Drops that touch become one; sliding drops leave trails on the film.
#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_shader_image_load_formatted : enable
// Plain, not fast: every pair is tested, and each texel looks at every drop.
#define DROPS_OUT 3
#include "drops.glsl"

layout(std140, binding = 0) uniform MergeUniforms {
  vec3 frame;       //   0  [m] As in IntegrateUniforms.
  float radius;     //  12  [m] Base radius over mass^(1/3).
  float trail;      //  16  [1/m^2] Mass units left over base radius and way.
  float dt;         //  20  [s] The step.
  ivec2 film;       //  24  [texel] Columns and rows of the film.
  float drying;     //  32  [1] Mass units that each texel of the film loses in this step.
  float padding_0;  //  36  padding
  float padding_1;  //  40  padding
  float padding_2;  //  44  padding
} u;
layout(binding = 2) uniform sampler2D film;
layout(binding = 4) uniform writeonly image2D film_given;

const int none = -1;
const float most_mass = 16777216.0;

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

// Mass units that a drop leaves, and the texel where.
float trail(Drop d, out ivec2 texel) {
  float radius = base_radius(d.mass), speed = length(to_plane(d.velocity));
  vec2 at = d.position - d.velocity * (radius / max(speed, 1e-12));
  texel = clamp(ivec2(at * vec2(u.film)), ivec2(0), u.film - 1);
  bool on_glass = d.life > 0.0 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)));
  float left = (u.trail * radius) * (speed * u.dt);
  return on_glass ? max(min(d.mass - 1.0, floor(left)), 0.0) : 0.0;
}

void main() {
  uint worker = gl_LocalInvocationIndex, n = min(drops.length(), given.length());
  if (worker == 0u) count = 0u;
  // The padding holds the place of the drop that each one ends in.
  for (uint i = worker; i < n; i += workers) {
    Drop d = drops[i];
    int to = none;
    for (uint j = 0u; j < n; ++j) {
      if (i == j || drops[j].life <= 0.0 || d.life <= 0.0 || !is_larger(drops[j], d) || !touching(d, drops[j])) continue;
      if (to == none || is_larger(drops[j], drops[to])) to = int(j);
    }
    d.padding_0 = intBitsToFloat(to);
    given[i] = d;
  }
  memoryBarrierBuffer();
  barrier();

  // The last of each chain takes those that lead to it, in ascending id. A drop that is taken is given the life 0.
  for (uint i = worker; i < n; i += workers) {
    if (floatBitsToInt(given[i].padding_0) != none || drops[i].life <= 0.0) continue;
    Drop sum = drops[i];
    bool any_left = true;
    uint after = 0u;
    while (any_left) {
      int next = none;
      for (uint j = 0u; j < n; ++j) {
        int root = floatBitsToInt(given[j].padding_0);
        if (root == none || drops[j].id < after || (next != none && drops[j].id > drops[next].id)) continue;
        for (int up = floatBitsToInt(given[root].padding_0); up != none; up = floatBitsToInt(given[root].padding_0)) {
          root = up;
        }
        if (root == int(i)) next = int(j);
      }
      any_left = next != none;
      if (!any_left) break;
      Drop d = drops[next];
      after = d.id + 1u;
      if (sum.mass + d.mass > most_mass) continue;
      sum.mass += d.mass;
      float share = d.mass / max(sum.mass, 1.0);
      sum.position = mix(sum.position, d.position, share);
      sum.velocity = mix(sum.velocity, d.velocity, share);
      given[next].life = 0.0;
    }
    given[i].position = sum.position;
    given[i].velocity = sum.velocity;
    given[i].mass = sum.mass;
    given[i].life = sum.life;
  }
  memoryBarrierBuffer();
  barrier();

  // The padding holds the trail now, which was of the drop's mass.
  for (uint i = worker; i < n; i += workers) {
    ivec2 texel;
    float quanta = given[i].life > 0.0 ? trail(given[i], texel) : 0.0;
    given[i].mass -= quanta;
    given[i].padding_0 = quanta;
  }
  memoryBarrierBuffer();
  barrier();
  for (uint i = worker; i < uint(u.film.x * u.film.y); i += workers) {
    ivec2 here = ivec2(int(i) % u.film.x, int(i) / u.film.x);
    float water = texelFetch(film, here, 0).x;
    water = max(water - u.drying, 0.0);
    for (uint j = 0u; j < n; ++j) {
      Drop d = given[j];
      if (d.padding_0 <= 0.0) continue;
      d.mass += d.padding_0;
      ivec2 texel;
      trail(d, texel);
      if (texel == here) water = min(water + d.padding_0, most_mass);
    }
    imageStore(film_given, here, vec4(water));
  }
  memoryBarrierBuffer();
  barrier();
  if (worker != 0u) return;
  uint kept = 0u;
  for (uint i = 0u; i < n; ++i) {
    Drop d = given[i];
    if (d.life <= 0.0) continue;
    d.padding_0 = 0.0;
    given[kept++] = d;
  }
  count = kept;
}
