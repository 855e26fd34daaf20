// windshield.normals, as-published. The normal of the water in axes of the glass, z outward.
fn tap(at: vec2i) -> f32 { return height_at(at) * dry_at(at); }

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let at = vec2i(place.xy);
  let across = vec2f(tap(at + vec2i(1, 0)) - tap(at - vec2i(1, 0)), tap(at + vec2i(0, 1)) - tap(at - vec2i(0, 1)));
  return stored_normal(across, 1.0);
}
