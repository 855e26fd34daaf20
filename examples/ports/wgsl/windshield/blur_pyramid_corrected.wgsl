// windshield.blur_pyramid, corrected. The scene in fog, and blurred levels of it; one run a level.
fn three(a: vec4f, b: vec4f, c: vec4f, middle: f32, last: f32) -> vec4f { return (a + middle * (b - a)) + last * (c - a); }
fn column(texel: vec2i, i: i32, last: f32) -> vec4f {
  return three(tap(texel, i, 0), tap(texel, i, 1), tap(texel, i, 2), u.middle.y, last);
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  if (u.level == 0) { return fogged(texel); }
  let last = u.last * (vec2f(texel) + 1.0);
  return three(column(texel, 0, last.y), column(texel, 1, last.y), column(texel, 2, last.y), u.middle.x, last.x);
}
