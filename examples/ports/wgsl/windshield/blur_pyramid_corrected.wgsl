// windshield.blur_pyramid, corrected. The scene in fog, and blurred levels of it; one run a level.
fn mirrored(place: vec2i) -> vec4f {
  var at = max(place, -1 - place);
  at = min(at, 2 * u.source_size - 1 - at);
  return textureLoad(blurred, clamp(at, vec2i(0), u.source_size - 1), 0);
}
fn bell(t0: vec4f, t1: vec4f, t2: vec4f, t3: vec4f, t4: vec4f) -> vec4f {
  return (0.375 * t2 + 0.25 * (t1 + t3)) + 0.0625 * (t0 + t4);
}
fn seven(t: array<vec4f, 7>, middle: f32, last: f32) -> vec4f {
  let a = bell(t[0], t[1], t[2], t[3], t[4]);
  let b = bell(t[1], t[2], t[3], t[4], t[5]);
  let c = bell(t[2], t[3], t[4], t[5], t[6]);
  return (a + middle * (b - a)) + last * (c - a);
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  if (u.level == 0) { return fogged(texel); }
  let last = u.last * (vec2f(texel) + 1.0);
  var columns: array<vec4f, 7>;
  for (var i = 0; i < 7; i++) {
    var rows: array<vec4f, 7>;
    for (var j = 0; j < 7; j++) { rows[j] = mirrored(2 * texel + vec2i(i - 2, j - 2)); }
    columns[i] = seven(rows, u.middle.y, last.y);
  }
  return seven(columns, u.middle.x, last.x);
}
