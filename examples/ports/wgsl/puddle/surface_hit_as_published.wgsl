// puddle.surface_hit, as-published. Where each pixel's view ray meets the water, and the normal there.

// The article reads the level before the newest, still encoded.
fn level(place: vec2f) -> f32 { return textureSampleLevel(wave, wave_sampler, place, 0.0).y; }
fn water_place(p: vec3f) -> vec2f { return 0.5 * (p.xz / u.half_size.xz + 1.0); }

// Distance from a box whose top the water displaces; 0 inside.
fn scene(p: vec3f) -> f32 {
  let d = level(water_place(p));
  return length(max(abs(p + vec3f(0.0, d, 0.0)) - u.half_size, vec3f(0.0)));
}

@fragment
fn main(@builtin(position) place: vec4f) -> Outputs {
  let ray = view_ray(vec2i(place.xy));
  var p = u.camera_position;
  var steps = 0.0;
  var hit = false;
  for (var i = 0; i < u.max_steps; i++) {
    let d = scene(p);
    steps = f32(i);
    hit = d < u.epsilon;
    // Away from a convex box for good.
    if (hit || d >= 1000.0) { break; }
    p += d * ray;
  }
  if (!hit) {
    p = u.camera_position;
    steps = f32(u.max_steps - 1);
  }

  let at = water_place(p);
  let texel = u.texel;
  let left = level(at - vec2f(texel.x, 0.0));
  let right = level(at + vec2f(texel.x, 0.0));
  let down = level(at - vec2f(0.0, texel.y));
  let up = level(at + vec2f(0.0, texel.y));
  let normal = normalize(vec3f((left - right) * u.normal_gain, 1.0, (down - up) * u.normal_gain));
  return Outputs(vec4f(p, steps), vec4f(normal, select(0.0, 1.0, hit)));
}
