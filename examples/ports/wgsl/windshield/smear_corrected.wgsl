// windshield.smear, corrected. The thin film that blades leave in streaks along their way, and what of it is not dry yet.
struct SmearUniforms {
  frame : vec3<f32>,    //   0  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  edge_width : f32,     //  12  [m] Width over which coverage falls at a blade's edge.
  inverse_water : f32,  //  16  [1/mm] 1 over the height of water that takes all of the film up.
  drying : f32,         //  20  [1/s] What of the thickness dries in a second.
  wiper_count : i32,    //  24  [1] Wipers in the list.
  padding_0 : f32,      //  28  padding
}
@group(0) @binding(0) var<uniform> u: SmearUniforms;
@group(0) @binding(1) var height: texture_2d<f32>;
@group(0) @binding(2) var wiped: texture_2d<f32>;
@group(0) @binding(3) var laid: texture_2d<f32>;
@group(0) @binding(4) var<storage, read> wipers: array<Wiper>;
@group(0) @binding(5) var profile: texture_2d<f32>;
@group(0) @binding(21) var profile_sampler: sampler;

struct Outputs {
  @location(0) smear: vec4f,
  @location(1) laid: vec4f,
}

// Of the annular sector that the blade swept, p from its pivot: as in wipe_texture.
fn sector_distance(w: Wiper, p: vec2f) -> f32 {
  let before = segment_distance(p, w.inner_radius * w.previous_axis, w.outer_radius * w.previous_axis);
  let now = segment_distance(p, w.inner_radius * w.axis, w.outer_radius * w.axis);
  let turn = select(1.0, -1.0, w.direction < 0.0);
  let after = turn * (p.x * w.previous_axis.y - p.y * w.previous_axis.x);
  let ahead = turn * (p.y * w.axis.x - p.x * w.axis.y);
  let beside = max(max(after, ahead), 0.0);
  let behind = max(-dot(p, w.previous_axis + w.axis), 0.0);
  let r = length(p);
  let between = max(max(w.inner_radius - r, r - w.outer_radius), 0.0) + 2.0 * (beside + behind);
  return min(min(before, now), between);
}

@fragment
fn main(@builtin(position) position: vec4f) -> Outputs {
  let texel = vec2i(position.xy);
  let at = vec2f(texel) + 0.5;
  let place = vec2f(u.frame.x * at.x + u.frame.y * at.y, u.frame.z * at.y);
  var film = textureLoad(laid, texel, 0).xyz;  // along the blade, and thickness
  for (var i = 0; i < u.wiper_count; i++) {
    let w = wipers[i];
    let p = place - w.pivot;
    let covered = clamp(0.5 + (w.half_width - sector_distance(w, p)) / u.edge_width, 0.0, 1.0);
    let r = length(p);
    let along = (r - w.inner_radius) / (w.outer_radius - w.inner_radius);
    let thickness = textureSampleLevel(profile, profile_sampler, vec2f(clamp(along, 0.0, 1.0), 0.5), 0.0).x;
    film = mix(film, vec3f(p * (1.0 / max(r, 1e-6)), thickness), covered);
  }
  let taken = min(textureLoad(height, texel, 0).x * u.inverse_water, 1.0);
  let left = film.z * (1.0 - taken);
  let dried = max(left - u.drying * textureLoad(wiped, texel, 0).x, 0.0);
  return Outputs(vec4f(film.xy, dried, 1.0), vec4f(film.xy, left, 1.0));
}
