// Distance of p from the segment from a to b.
float segment_distance(vec2 p, vec2 a, vec2 b) {
  vec2 along = b - a, from = p - a;
  float t = clamp(dot(from, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  return length(from - t * along);
}
