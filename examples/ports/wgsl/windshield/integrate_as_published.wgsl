// windshield.integrate, as-published. Forces, motion, evaporation and age of every drop.
@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  let frame = glass_frame[0];
  for (var i = worker; i < arrayLength(&drops); i += workers) {
    var d = drops[i];
    if (d.life <= 0.0) { continue; }
    let inertia = frame.acceleration * u.inertia_coupling;
    let a = frame.gravity * d.mass - inertia + frame.wind * u.wind_coupling - d.velocity * u.drag;
    d.velocity += a * u.dt;
    d.position += d.velocity * u.dt;
    d.life -= u.dt;
    if (d.life > 0.0) { append(d); }
  }
}
