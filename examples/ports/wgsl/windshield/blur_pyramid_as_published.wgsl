// windshield.blur_pyramid, as-published. The scene in fog, and blurred levels of it; one run a level.
@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  if (u.level == 0) { return fogged(texel); }
  let sum = (tap(texel, 0, 0) + tap(texel, 1, 0)) + (tap(texel, 0, 1) + tap(texel, 1, 1));
  return 0.25 * sum;
}
