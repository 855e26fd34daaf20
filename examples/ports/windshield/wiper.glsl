// Blades, in plane coordinates [m].
#include "wiper_record.glsl"
layout(std430, binding = 2) readonly buffer WiperBuffer { Wiper wipers[]; };

layout(std140, binding = 0) uniform WipeDropsUniforms {
  vec3 frame;          //   0  [m] x = f0 u + f1 v, y = f2 v: plane coordinates of glass coordinates.
  float follow;        //  12  [1] as-published: share of the way to the leading edge that a captured drop makes.
  vec3 inverse_frame;  //  16  [1/m] u = i0 x + i1 y, v = i2 y.
  float inherit;       //  28  [1] as-published: share of the blade's velocity that a captured drop takes over.
  float gain;          //  32  [1] as-published: mass that a captured drop gains.
  float radius_scale;  //  36  [m] corrected: base radius of a drop of one mass unit.
  int wiper_count;     //  40  [1] Records in the list of wipers.
  int bin_count;       //  44  [1] corrected: radial bins that share out the film.
  vec2 texel;          //  48  [1] corrected: 1 over the film's columns and rows.
  int columns;         //  56  [texel] corrected: columns of the film.
  int rows;            //  60  [texel] corrected: rows of the film.
} u;

vec2 to_plane(vec2 uv) { return vec2(u.frame.x * uv.x + u.frame.y * uv.y, u.frame.z * uv.y); }
vec2 to_glass(vec2 p) { return vec2(u.inverse_frame.x * p.x + u.inverse_frame.y * p.y, u.inverse_frame.z * p.y); }

// r: from the pivot.
float along_blade(Wiper w, vec2 axis, vec2 r) { return clamp(r.x * axis.x + r.y * axis.y, w.inner_radius, w.outer_radius); }
bool under_blade(Wiper w, vec2 axis, vec2 r) {
  vec2 off = r - along_blade(w, axis, r) * axis;
  return off.x * off.x + off.y * off.y <= w.half_width * w.half_width;
}
