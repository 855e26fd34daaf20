// windshield.wipe_texture, as-published. What the blades take off the height, and the mask of freshly wiped glass.
@group(0) @binding(2) var mask: texture_2d<f32>;

struct Outputs {
  @location(0) height: vec4f,
  @location(1) mask: vec4f,
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let texel = vec2i(place.xy);
  var coverage = 0.0;
  for (var i = 0; i < u.wiper_count; i++) {
    let w = wipers[i];
    let away = segment_distance(in_plane(texel), w.inner * u.axis_length, w.outer * u.axis_length);
    coverage = max(coverage, coverage_at(away, w));
  }
  let left = max(textureLoad(height, texel, 0).x - u.strength * coverage, 0.0);
  let wiped = max(textureLoad(mask, texel, 0).x * u.keep, coverage);
  return Outputs(vec4f(left, 0.0, 0.0, 0.0), vec4f(wiped, 0.0, 0.0, 0.0));
}
