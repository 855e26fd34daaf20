// Distance of p from the segment from a to b.
fn segment_distance(p: vec2f, a: vec2f, b: vec2f) -> f32 {
  let along = b - a;
  let offset = p - a;
  let t = clamp(dot(offset, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  return length(offset - t * along);
}
