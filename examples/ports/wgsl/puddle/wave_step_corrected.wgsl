// puddle.wave_step, corrected. The next level of the water from the newest and the previous one.
override shore_present: bool;
@group(0) @binding(3) var shore: texture_2d<f32>;

// The crater of a drop: (1 - q^2)^2 (1 - 4 q^2) for q = r / R < 1.
fn crater(drop: Drop, here: vec2f) -> f32 {
  let inverse = 1.0 / drop.radius;
  let scaled = (here - vec2f(drop.x, drop.y)) * inverse;
  let q2 = dot(scaled, scaled);
  let rim = max(1.0 - q2, 0.0);
  return drop.amplitude * (rim * rim * (1.0 - 4.0 * q2));
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  let stored = wave_texel(texel);
  let newest = stored.x;
  var previous = stored.y;
  let left = wave_texel(texel - vec2i(1, 0)).x;
  let right = wave_texel(texel + vec2i(1, 0)).x;
  let down = wave_texel(texel - vec2i(0, 1)).x;
  let up = wave_texel(texel + vec2i(0, 1)).x;
  let around = left + right + down + up;
  let laplacian = around - 4.0 * newest;

  // A rim along the edges swallows waves: it takes its share of both levels.
  let here = vec2f(texel) + 0.5;
  var rim = 1.0;
  if (u.rim_damping > 0.0) {
    let edge = min(here, u.size - here);
    let depth = max(1.0 - u.rim_inverse * min(edge.x, edge.y), 0.0);
    rim = 1.0 - u.rim_damping * (depth * depth);
    previous = u.rest + rim * (previous - u.rest);
  }

  let gamma = u.damping;
  var craters = 0.0;
  for (var i = 0; i < u.drop_count; i++) { craters += crater(drops[i], here); }

  var next = newest + gamma * (newest - previous) + u.courant_sq * laplacian + craters;
  var kept = 1.0;
  if (shore_present) { kept = textureLoad(shore, texel, 0).x; }
  if (shore_present || u.rim_damping > 0.0) { next = u.rest + kept * rim * (next - u.rest); }
  return vec4f(next, newest + kept * craters, 0.0, 0.0);
}
