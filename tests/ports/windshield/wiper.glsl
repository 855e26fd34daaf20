// Blades, in plane coordinates [m].
struct Wiper {
  vec2 previous_inner;  //   0  [1] Inner end before the step, glass coordinates.
  vec2 previous_outer;  //   8  [1] Outer end before the step.
  vec2 inner;           //  16  [1] Inner end after it.
  vec2 outer;           //  24  [1] Outer end after it.
  vec2 pivot;           //  32  [m] Plane coordinates.
  float inner_radius;   //  40  [m] Of the inner end, from the pivot.
  float outer_radius;   //  44  [m] Of the outer end.
  vec2 previous_axis;   //  48  [1] Cosine and sine of the blade's angle before the step.
  vec2 axis;            //  56  [1] The same after it.
  float half_width;     //  64  [m] Half the width that the blade wipes.
  float rate;           //  68  [rad/s] Turned angle over the time that the record stands for.
  float direction;      //  72  [1] Sign of rate; 0 at rest.
  float padding_0;      //  76  padding
};
layout(std430, binding = 2) readonly buffer WiperBuffer { Wiper wipers[]; };

layout(std140, binding = 0) uniform WipeDropsUniforms {
  vec3 frame;          //   0  [m] x = f0 u + f1 v, y = f2 v: plane coordinates of glass coordinates.
  float follow;        //  12  [1] as-published: share of the way to the leading edge that a captured drop makes.
  vec3 inverse_frame;  //  16  [1/m] u = i0 x + i1 y, v = i2 y.
  float inherit;       //  28  [1] as-published: share of the blade's velocity that a captured drop takes over.
  float gain;          //  32  [1] as-published: mass that a captured drop gains.
  float radius_scale;  //  36  [m] corrected: base radius of a drop of one quantum.
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
