// windshield.wipe_drops, as-published. Drops in the swept area ride on the blade.
#version 450
#extension GL_GOOGLE_include_directive : enable
#define DROPS_OUT 3
#include "drops.glsl"
#include "wiper.glsl"

bool inward(float direction, vec2 a, vec2 b, vec2 p) { return direction * ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) >= 0.0; }
bool in_quad(Wiper w, vec2 p) {
  vec2 a = to_plane(w.previous_inner), b = to_plane(w.previous_outer), c = to_plane(w.outer), d = to_plane(w.inner);
  float turn = w.direction;
  return inward(turn, a, b, p) && inward(turn, b, c, p) && inward(turn, c, d, p) && inward(turn, d, a, p);
}

void main() {
  if (gl_LocalInvocationIndex == 0u) count = 0u;
  memoryBarrierBuffer();
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < drops.length(); i += workers) {
    Drop d = drops[i];
    if (d.life <= 0.0) continue;
    for (int k = 0; k < u.wiper_count; ++k) {
      Wiper w = wipers[k];
      if (w.direction == 0.0) continue;
      vec2 p = to_plane(d.position), r = p - w.pivot;
      if (!(in_quad(w, p) || under_blade(w, w.axis, r))) continue;
      float lead = w.half_width * w.direction, along = along_blade(w, w.axis, r);
      vec2 t = along * w.axis + lead * vec2(-w.axis.y, w.axis.x);
      vec2 target = to_glass(w.pivot + t), velocity = to_glass(w.rate * vec2(-t.y, t.x));
      d.position = mix(d.position, target, u.follow);
      d.velocity = mix(d.velocity, velocity, u.inherit);
      d.mass += u.gain;
    }
    append(d);
  }
}
