// What both wipe_textures share.
struct WipeTextureUniforms {
  frame : vec3<f32>,        //   0  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  edge_width : f32,         //  12  [m] Width over which coverage falls at a blade's edge.
  axis_length : vec2<f32>,  //  16  [m] as-published: lengths of the axes u and v.
  strength : f32,           //  24  [mm] as-published: what full coverage takes off the height.
  keep : f32,               //  28  [1] as-published: share of the mask that a frame leaves.
  dt : f32,                 //  32  [s] corrected: time since the frame before, so rounded that sums are exact.
  inverse_tau : f32,        //  36  [1/s] corrected: 1 over the time constant of the mask.
  wiped_limit : f32,        //  40  [s] corrected: the time since a wipe grows to this and no further.
  wiper_count : i32,        //  44  [1] Wipers in the list.
}
@group(0) @binding(0) var<uniform> u: WipeTextureUniforms;
@group(0) @binding(1) var height: texture_2d<f32>;
@group(0) @binding(3) var<storage, read> wipers: array<Wiper>;

fn coverage_at(away: f32, w: Wiper) -> f32 { return clamp(0.5 + (w.half_width - away) / u.edge_width, 0.0, 1.0); }
fn in_plane(texel: vec2i) -> vec2f {
  let at = vec2f(texel) + 0.5;
  return vec2f(u.frame.x * at.x + u.frame.y * at.y, u.frame.z * at.y);
}
