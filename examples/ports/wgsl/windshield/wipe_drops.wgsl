// What both versions of wipe_drops share: blades, in plane coordinates [m].
struct WipeDropsUniforms {
  frame : vec3<f32>,          //   0  [m] x = f0 u + f1 v, y = f2 v: plane coordinates of glass coordinates.
  follow : f32,               //  12  [1] as-published: share of the way to the leading edge that a captured drop makes.
  inverse_frame : vec3<f32>,  //  16  [1/m] u = i0 x + i1 y, v = i2 y.
  inherit : f32,              //  28  [1] as-published: share of the blade's velocity that a captured drop takes over.
  gain : f32,                 //  32  [1] as-published: mass that a captured drop gains.
  radius_scale : f32,         //  36  [m] corrected: base radius of a drop of one mass unit.
  wiper_count : i32,          //  40  [1] Records in the list of wipers.
  bin_count : i32,            //  44  [1] corrected: radial bins that share out the film.
  texel : vec2<f32>,          //  48  [1] corrected: 1 over the film's columns and rows.
  columns : i32,              //  56  [texel] corrected: columns of the film.
  rows : i32,                 //  60  [texel] corrected: rows of the film.
}
@group(0) @binding(0) var<uniform> u: WipeDropsUniforms;
@group(0) @binding(2) var<storage, read> wipers: array<Wiper>;

fn to_plane(uv: vec2f) -> vec2f { return vec2f(u.frame.x * uv.x + u.frame.y * uv.y, u.frame.z * uv.y); }
fn to_glass(p: vec2f) -> vec2f { return vec2f(u.inverse_frame.x * p.x + u.inverse_frame.y * p.y, u.inverse_frame.z * p.y); }

// r: from the pivot.
fn along_blade(w: Wiper, axis: vec2f, r: vec2f) -> f32 { return clamp(r.x * axis.x + r.y * axis.y, w.inner_radius, w.outer_radius); }
fn under_blade(w: Wiper, axis: vec2f, r: vec2f) -> bool {
  let off = r - along_blade(w, axis, r) * axis;
  return off.x * off.x + off.y * off.y <= w.half_width * w.half_width;
}
