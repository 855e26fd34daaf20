// windshield.wipe_texture, corrected. What the blades take off the height, and the mask of freshly wiped glass.
@group(0) @binding(2) var wiped: texture_2d<f32>;

struct Outputs {
  @location(0) height: vec4f,
  @location(1) mask: vec4f,
  @location(2) wiped: vec4f,
}

// Distance to the annular sector that the blade swept, as the document derives it.
fn sector_distance(w: Wiper, at: vec2f) -> f32 {
  let p = at - w.pivot;
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
fn main(@builtin(position) place: vec4f) -> Outputs {
  let texel = vec2i(place.xy);
  var coverage = 0.0;
  for (var i = 0; i < u.wiper_count; i++) {
    coverage = max(coverage, coverage_at(sector_distance(wipers[i], in_plane(texel)), wipers[i]));
  }
  var since = min(textureLoad(wiped, texel, 0).x + u.dt, u.wiped_limit);
  since *= 1.0 - coverage;
  let left = textureLoad(height, texel, 0).x * (1.0 - coverage);
  let shown = exp(-(since * u.inverse_tau));
  return Outputs(vec4f(left, 0.0, 0.0, 0.0), vec4f(shown, 0.0, 0.0, 0.0), vec4f(since, 0.0, 0.0, 0.0));
}
