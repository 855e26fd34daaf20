// windshield.wipe_drops, corrected. Drops in the swept area ride on the blade, with the film that it sweeps.
#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_shader_image_load_formatted : enable
// Whole mass units are integers here, so that sums are exact in any order.
#define DROPS_OUT 4
#include "drops.glsl"
#include "wiper.glsl"

layout(binding = 3) uniform sampler2D film;
layout(binding = 5) uniform writeonly image2D film_given;

const int most_places = 1024, none = -1, thrown_off = -2;
const uint most_mass = 1u << 24;
// For each record and bin: what the film gives, 64 bits of it, and the lowest id among the drops there.
shared uint quanta_low[most_places], quanta_high[most_places], taker[most_places];

bool in_sweep(Wiper w, vec2 p) {
  vec2 r = p - w.pivot;
  float past_first = w.direction * (w.previous_axis.x * r.y - w.previous_axis.y * r.x);
  float past_last = w.direction * (w.axis.x * r.y - w.axis.y * r.x);
  vec2 both = w.previous_axis + w.axis;
  float side = both.x * r.x + both.y * r.y, radius_sq = r.x * r.x + r.y * r.y;
  float inner = w.inner_radius - w.half_width, outer = w.outer_radius + w.half_width;
  bool sector = past_first >= 0.0 && past_last <= 0.0 && side > 0.0 && radius_sq >= inner * inner && radius_sq <= outer * outer;
  return sector || under_blade(w, w.previous_axis, r) || under_blade(w, w.axis, r);
}
int place_of(int record, vec2 p) {
  Wiper w = wipers[record];
  vec2 r = p - w.pivot;
  float bins = float(u.bin_count), width = (w.outer_radius - w.inner_radius) + 2.0 * w.half_width;
  float from = w.inner_radius - w.half_width;
  return record * u.bin_count + int(clamp(floor((length(r) - from) * (bins / width)), 0.0, bins - 1.0));
}

// Moves a drop; its place, or none, or thrown_off.
int wipe(inout Drop d) {
  int place = none;
  float base_radius = u.radius_scale * pow(max(d.mass, 0.0), 1.0 / 3.0);
  for (int i = 0; i < 2 * u.wiper_count; ++i) {
    int record = i % u.wiper_count;
    Wiper w = wipers[record];
    vec2 p = to_plane(d.position);
    if (w.direction == 0.0 || !in_sweep(w, p)) continue;
    float radius = length(p - w.pivot);
    float s = min((w.half_width + base_radius) / max(radius, w.half_width), 1.0), c = sqrt(max(1.0 - s * s, 0.0));
    float turned = w.direction * s;
    vec2 r = radius * vec2(c * w.axis.x - turned * w.axis.y, c * w.axis.y + turned * w.axis.x);
    d.position = to_glass(w.pivot + r);
    d.velocity = to_glass(w.rate * vec2(-r.y, r.x));
    place = place_of(record, p);
  }
  vec2 p = to_plane(d.position);
  for (int i = 0; i < u.wiper_count; ++i) {
    if (wipers[i].direction != 0.0 && in_sweep(wipers[i], p)) place = thrown_off;
  }
  return place;
}

void main() {
  uint worker = gl_LocalInvocationIndex;
  if (worker == 0u) count = 0u;
  for (uint i = worker; i < most_places; i += workers) {
    quanta_low[i] = quanta_high[i] = 0u;
    taker[i] = 0xffffffffu;
  }
  memoryBarrierBuffer();
  barrier();

  for (uint i = worker; i < u.columns * u.rows; i += workers) {
    ivec2 texel = ivec2(i % u.columns, i / u.columns);
    float here = texelFetch(film, texel, 0).x;
    vec2 p = to_plane((vec2(texel) + 0.5) * u.texel);
    float left = here;
    for (int k = 0; k < u.wiper_count; ++k) {
      if (wipers[k].direction == 0.0 || !in_sweep(wipers[k], p)) continue;
      left = 0.0;
      int place = place_of(k, p);
      uint water = uint(here), before = atomicAdd(quanta_low[place], water);
      if (before + water < before) atomicAdd(quanta_high[place], 1u);
      break;
    }
    imageStore(film_given, texel, vec4(left));
  }
  // The place rides in the padding until the water is handed on.
  for (uint i = worker; i < drops.length(); i += workers) {
    Drop d = drops[i];
    if (d.life <= 0.0) continue;
    int place = wipe(d);
    if (place == thrown_off) continue;
    if (place >= 0) atomicMin(taker[place], d.id);
    uint at = append(d);
    if (at < given.length()) given[at].padding_0 = intBitsToFloat(place >= 0 ? place : none);
  }
  memoryBarrierBuffer();
  barrier();
  for (uint i = worker; i < min(count, given.length()); i += workers) {
    int place = floatBitsToInt(given[i].padding_0);
    given[i].padding_0 = 0.0;
    if (place < 0 || taker[place] != given[i].id) continue;
    uint have = uint(given[i].mass), room = most_mass - min(have, most_mass);
    uint gained = quanta_high[place] > 0u ? room : min(quanta_low[place], room);
    given[i].mass = float(have + gained);
  }
}
