// windshield.integrate, corrected. Forces, motion, evaporation and age of every drop.
fn length_on_glass(a: vec2f) -> f32 { return length(vec2f(u.frame.x * a.x + u.frame.y * a.y, u.frame.z * a.y)); }
fn times(rows: vec4f, a: vec2f) -> vec2f { return vec2f(rows.x * a.x + rows.y * a.y, rows.z * a.x + rows.w * a.y); }

// e^-x, and the shares of velocity and way: (1 - e^-x) / x and (1 - that) / x.
fn decay_of(x: f32) -> vec3f {
  let speed = exp(-x);
  if (x < 0.125) {
    let g = 0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0))));
    return vec3f(speed, 1.0 - x * g, g);
  }
  let mean = (1.0 - speed) / x;
  return vec3f(speed, mean, (1.0 - mean) / x);
}

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  let frame = glass_frame[0];
  for (var i = worker; i < arrayLength(&drops); i += workers) {
    let d = drops[i];
    if (d.life <= 0.0) { continue; }
    let mass_3 = pow(max(d.mass, 1.0), 1.0 / 3.0);
    let inverse = 1.0 / mass_3;
    let inverse_sq = inverse * inverse;

    let push = u.wind_push * length_on_glass(frame.wind) * inverse;
    let spin = times(frame.spin, d.position);
    let coriolis = times(frame.coriolis, d.velocity);
    let a = frame.gravity + spin + coriolis + push * frame.wind;
    let pull = max(length_on_glass(a), 1e-6);
    let share = max(1.0 - (u.hold * inverse_sq) / pull, 0.0);
    let pushed = (a * share) * u.dt;
    let decay = decay_of(u.drag * inverse_sq * u.dt);
    let velocity = d.velocity * decay.x + pushed * decay.y;
    let position = d.position + (d.velocity * decay.y + pushed * decay.z) * u.dt;
    let rests = share <= 0.0 && length_on_glass(velocity) < u.rest_speed;

    let life = d.life - u.dt;
    let loss = u.evaporation * mass_3 * u.dt;
    let phase = fract(fract(d.life / 64.0) * u.phase_rate);
    let mass = max(d.mass - floor(loss + phase), 0.0);
    let inside = all(position >= vec2f(-u.margin)) && all(position <= vec2f(1.0 + u.margin));
    if (!(life > 0.0 && mass > 0.0 && inside)) { continue; }
    append(Drop(position, select(velocity, vec2f(0.0), rests), mass, life, d.id, 0.0));
  }
}
