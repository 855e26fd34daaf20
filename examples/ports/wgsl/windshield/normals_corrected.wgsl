// windshield.normals, corrected. The normal of the water in axes of the glass, z outward.
@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let at = vec2i(place.xy);
  let across = vec2f(height_at(at + vec2i(1, 0)) - height_at(at - vec2i(1, 0)), height_at(at + vec2i(0, 1)) - height_at(at - vec2i(0, 1)));
  return stored_normal(across, dry_at(at));
}
