// windshield.necks, corrected. Outlines of drops that become one stay, with a neck, and recede.
// Plain, not fast: every pair is tested. A list without records is bound as one of zeros, of which nothing is left.
struct NecksUniforms {
  frame : vec3<f32>,  //   0  [m] As in IntegrateUniforms.
  radius : f32,       //  12  [m] Base radius over mass^(1/3).
  dt : f32,           //  16  [s] The step.
  keep : f32,         //  20  [1] What a step leaves of a neck.
  padding_0 : f32,    //  24  padding
  padding_1 : f32,    //  28  padding
}
@group(0) @binding(0) var<uniform> u: NecksUniforms;
struct Drop {
  position : vec2<f32>,  //   0  [1] Glass coordinates u, v.
  velocity : vec2<f32>,  //   8  [1/s] Change of the position.
  mass : f32,            //  16  [1] as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24.
  life : f32,            //  20  [s] What remains; not above 0: no drop.
  id : u32,              //  24  [1] Its own for ever, ascending in the order of birth.
  padding_0 : f32,       //  28  padding
}
@group(0) @binding(1) var<storage, read> drops: array<Drop>;
@group(0) @binding(2) var<storage, read> necks: array<Neck>;
struct NecksOutBuffer {
  count : atomic<u32>,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<Neck>,
}
@group(0) @binding(3) var<storage, read_write> necks_out: NecksOutBuffer;

const none = -1;
const workers = 64u;

fn base_radius(mass: f32) -> f32 { return u.radius * pow(max(mass, 1.0), 1.0 / 3.0); }
fn to_plane(uv: vec2f) -> vec2f { return vec2f(u.frame.x * uv.x + u.frame.y * uv.y, u.frame.z * uv.y); }
fn touching(a: Drop, b: Drop) -> bool {
  let apart = to_plane(a.position) - to_plane(b.position);
  let reach = base_radius(a.mass) + base_radius(b.mass);
  return apart.x * apart.x + apart.y * apart.y < reach * reach;
}
fn is_larger(a: Drop, b: Drop) -> bool {
  if (a.mass != b.mass) { return a.mass > b.mass; }
  return a.id < b.id;
}
fn stands_out(neck: Neck) -> bool {
  let radii = footprints(neck);
  return neck.left > 1.0 / 64.0 && length(neck.offset) * neck.left + radii.y > radii.x;
}
// The largest of the drops that are larger than drop i and touch it.
fn larger_of(i: i32) -> i32 {
  var to = none;
  for (var j = 0; j < i32(arrayLength(&drops)); j++) {
    if (j == i || drops[j].life <= 0.0 || !is_larger(drops[j], drops[i])) { continue; }
    if (!touching(drops[i], drops[j])) { continue; }
    if (to == none || is_larger(drops[j], drops[to])) { to = j; }
  }
  return to;
}
fn joined(a: Drop, b: Drop) -> Neck {
  let mass = a.mass + b.mass;
  let offset = to_plane(b.position - a.position) * (1.0 / base_radius(mass));
  return Neck(offset, b.mass / max(mass, 1.0), 1.0, a.id, 0.0, 0.0, 0.0);
}

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  let n = i32(arrayLength(&drops));
  for (var i = i32(worker); i < n; i += i32(workers)) {
    let d = drops[i];
    if (d.life <= 0.0 || larger_of(i) != none) { continue; }
    var neck = no_neck(d.id);
    for (var j = 0u; j < arrayLength(&necks); j++) {
      if (necks[j].id != d.id) { continue; }
      neck = necks[j];
      let way = length(to_plane(d.velocity)) * u.dt;
      neck.left = max(neck.left * u.keep - way / base_radius(d.mass), 0.0);
    }
    var largest = none;
    for (var j = 0; j < n; j++) {
      if (j == i || drops[j].life <= 0.0 || !is_larger(d, drops[j]) || !touching(d, drops[j])) { continue; }
      if (largest != none && !is_larger(drops[j], drops[max(largest, 0)])) { continue; }
      if (larger_of(j) == i) { largest = j; }
    }
    if (largest != none) {
      let fresh = joined(d, drops[largest]);
      if (stands_out(fresh) && !(neck.share * neck.left > fresh.share)) { neck = fresh; }
    }
    if (!stands_out(neck)) { continue; }
    let at = atomicAdd(&necks_out.count, 1u);
    if (at < arrayLength(&necks_out.records)) { necks_out.records[at] = neck; }
  }
}
