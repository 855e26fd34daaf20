// puddle.wave_step, as-published. The next level of the water from the newest and the previous one.

// WGSL gives no value for smoothstep(4, 0.5, x); this is its formula.
fn falling_smoothstep(edge0: f32, edge1: f32, x: f32) -> f32 {
  let t = clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Newest level at an offset of `step` texels along an axis; a fraction reads between texels.
fn neighbour(texel: vec2i, axis: vec2i) -> f32 {
  let whole = i32(u.step);
  let fraction = u.step - f32(whole);
  let level = wave_texel(texel + whole * axis).x;
  if (fraction == 0.0) { return level; }
  return mix(level, wave_texel(texel + (whole + 1) * axis).x, fraction);
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  let stored = wave_texel(texel);
  let down = neighbour(texel, vec2i(0, -1));
  let left = neighbour(texel, vec2i(-1, 0));
  let right = neighbour(texel, vec2i(1, 0));
  let up = neighbour(texel, vec2i(0, 1));

  let previous = stored.y;
  var d = -2.0 * (previous - 0.5) + (down + left + right + up - 2.0);
  d *= u.damping;

  let here = vec2f(texel) + 0.5;
  for (var i = 0; i < u.drop_count; i++) {
    if (drops[i].amplitude > 0.01) {
      let r = distance(vec2f(drops[i].x, drops[i].y), here);
      d += drops[i].amplitude * falling_smoothstep(4.0, 0.5, r);
    }
  }
  return vec4f(0.5 * d + 0.5, stored.x, 0.0, 0.0);
}
