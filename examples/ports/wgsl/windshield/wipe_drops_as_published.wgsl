// windshield.wipe_drops, as-published. Drops in the swept area ride on the blade.
@group(0) @binding(3) var<storage, read_write> drops_out: DropsOutBuffer;

fn inward(direction: f32, a: vec2f, b: vec2f, p: vec2f) -> bool {
  return direction * ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) >= 0.0;
}
fn in_quad(w: Wiper, p: vec2f) -> bool {
  let a = to_plane(w.previous_inner);
  let b = to_plane(w.previous_outer);
  let c = to_plane(w.outer);
  let d = to_plane(w.inner);
  let turn = w.direction;
  return inward(turn, a, b, p) && inward(turn, b, c, p) && inward(turn, c, d, p) && inward(turn, d, a, p);
}

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  for (var i = worker; i < arrayLength(&drops); i += workers) {
    var d = drops[i];
    if (d.life <= 0.0) { continue; }
    for (var k = 0; k < u.wiper_count; k++) {
      let w = wipers[k];
      if (w.direction == 0.0) { continue; }
      let p = to_plane(d.position);
      let r = p - w.pivot;
      if (!(in_quad(w, p) || under_blade(w, w.axis, r))) { continue; }
      let lead = w.half_width * w.direction;
      let t = along_blade(w, w.axis, r) * w.axis + lead * vec2f(-w.axis.y, w.axis.x);
      let target_place = to_glass(w.pivot + t);
      let velocity = to_glass(w.rate * vec2f(-t.y, t.x));
      d.position = mix(d.position, target_place, u.follow);
      d.velocity = mix(d.velocity, velocity, u.inherit);
      d.mass += u.gain;
    }
    append(d);
  }
}
