#version 450
#extension GL_GOOGLE_include_directive : enable
// Seeded bugs: 1171 to 1180.
#define DROPS_OUT 3
#include "drops.glsl"
#include "wiper.glsl"

bool inward(float direction, vec2 a, vec2 b, vec2 p) { return direction * ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) >= 0.0; }
bool in_quad(Wiper w, vec2 p) {
  vec2 a = to_plane(w.previous_inner), b = to_plane(w.previous_outer), c = to_plane(w.outer), d = to_plane(w.inner);
  float turn = BUG == 1171 ? 1.0 : w.direction;
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
      if (w.direction == 0.0 && BUG != 1172) continue;
      vec2 p = to_plane(d.position), r = p - w.pivot;
      if (!((in_quad(w, p) && BUG != 1173) || under_blade(w, w.axis, r))) continue;
      float lead = w.half_width * (BUG == 1174 ? -w.direction : w.direction), along = along_blade(w, w.axis, r);
      vec2 t = along * w.axis + lead * vec2(-w.axis.y, w.axis.x);
      vec2 target = to_glass(w.pivot + t), velocity = to_glass(w.rate * vec2(-t.y, t.x));
      if (BUG == 1175) velocity = w.rate * vec2(-t.y, t.x);
      d.position = mix(d.position, target, BUG == 1176 ? 1.0 : u.follow);
      d.velocity = mix(d.velocity, velocity, BUG == 1177 ? u.follow : u.inherit);
      d.mass += BUG == 1178 ? 1.01 * u.gain : u.gain;
    }
    append(d);
  }
}
