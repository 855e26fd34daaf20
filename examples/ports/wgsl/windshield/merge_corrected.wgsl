// windshield.merge, corrected. Drops that touch become one; sliding drops leave trails on the film.
// Plain, not fast: every pair is tested, and each texel looks at every drop. While the pass runs, a record's index is the drop that it
// ends in, and then the mass of its trail.
struct MergeUniforms {
  frame : vec3<f32>,  //   0  [m] As in IntegrateUniforms.
  radius : f32,       //  12  [m] Base radius over mass^(1/3).
  trail : f32,        //  16  [1/m^2] Mass units left over base radius and way.
  dt : f32,           //  20  [s] The step.
  film : vec2<i32>,   //  24  [texel] Columns and rows of the film.
  drying : f32,       //  32  [1] Mass units that each texel of the film loses in this step.
  padding_0 : f32,    //  36  padding
  padding_1 : f32,    //  40  padding
  padding_2 : f32,    //  44  padding
}
@group(0) @binding(0) var<uniform> u: MergeUniforms;
@group(0) @binding(2) var film: texture_2d<f32>;
struct DropsOutBuffer {
  count : u32,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<IndexedDrop>,
}
@group(0) @binding(3) var<storage, read_write> drops_out: DropsOutBuffer;
@group(0) @binding(4) var film_out: texture_storage_2d<r32float, write>;

const most_mass = 16777216.0;

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

// The drop that drop i goes into: the largest that it touches and that is larger; or none.
fn absorbing_drop(i: u32, n: u32) -> i32 {
  let d = drops[i];
  var to = none;
  for (var j = 0u; j < n; j++) {
    if (i == j || drops[j].life <= 0.0 || d.life <= 0.0) { continue; }
    if (!is_larger(drops[j], d) || !touching(d, drops[j])) { continue; }
    if (to == none || is_larger(drops[j], drops[to])) { to = i32(j); }
  }
  return to;
}
// The last of the chain that begins with drop j.
fn last_of_chain(j: u32) -> i32 {
  var root = i32(j);
  while (drops_out.records[root].index != none) { root = drops_out.records[root].index; }
  return root;
}
// Drop i with those that lead to it, in ascending id. A drop that is taken is given the life 0.
fn gathered(i: u32, n: u32) -> Drop {
  var sum = drops[i];
  var after = 0u;
  loop {
    var next = none;
    for (var j = 0u; j < n; j++) {
      if (drops_out.records[j].index == none || drops[j].id < after) { continue; }
      if (next != none && drops[j].id > drops[next].id) { continue; }
      if (last_of_chain(j) == i32(i)) { next = i32(j); }
    }
    if (next == none) { break; }
    let d = drops[next];
    after = d.id + 1u;
    if (sum.mass + d.mass > most_mass) { continue; }
    sum.mass += d.mass;
    let share = d.mass / max(sum.mass, 1.0);
    sum.position = mix(sum.position, d.position, share);
    sum.velocity = mix(sum.velocity, d.velocity, share);
    drops_out.records[next].life = 0.0;
  }
  return sum;
}

// Mass units that a drop leaves, and the texel where.
struct Trail {
  quanta : f32,
  texel : vec2i,
}
fn trail_of(d: Drop) -> Trail {
  let radius = base_radius(d.mass);
  let speed = length(to_plane(d.velocity));
  let at = d.position - d.velocity * (radius / max(speed, 1e-12));
  let texel = clamp(vec2i(at * vec2f(u.film)), vec2i(0), u.film - 1);
  let on_glass = d.life > 0.0 && all(at >= vec2f(0.0)) && all(at < vec2f(1.0));
  let left = (u.trail * radius) * (speed * u.dt);
  return Trail(select(0.0, max(min(d.mass - 1.0, floor(left)), 0.0), on_glass), texel);
}
// The film at a texel, dried, with the trails that end there.
fn next_film(here: vec2i, n: u32) -> f32 {
  var water = max(textureLoad(film, here, 0).x - u.drying, 0.0);
  for (var j = 0u; j < n; j++) {
    let d = drops_out.records[j];
    if (d.index <= 0) { continue; }
    var before = drop_of(d);
    before.mass += f32(d.index);
    if (all(trail_of(before).texel == here)) { water = min(water + f32(d.index), most_mass); }
  }
  return water;
}

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  let n = min(arrayLength(&drops), arrayLength(&drops_out.records));
  for (var i = worker; i < n; i += workers) { drops_out.records[i] = indexed(drops[i], absorbing_drop(i, n)); }
  storageBarrier();

  for (var i = worker; i < n; i += workers) {
    if (drops_out.records[i].index != none || drops[i].life <= 0.0) { continue; }
    drops_out.records[i] = indexed(gathered(i, n), none);
  }
  storageBarrier();

  for (var i = worker; i < n; i += workers) {
    let d = drop_of(drops_out.records[i]);
    var quanta = 0.0;
    if (d.life > 0.0) { quanta = trail_of(d).quanta; }
    drops_out.records[i].mass -= quanta;
    drops_out.records[i].index = i32(quanta);
  }
  storageBarrier();

  for (var i = i32(worker); i < u.film.x * u.film.y; i += i32(workers)) {
    let here = vec2i(i % u.film.x, i / u.film.x);
    textureStore(film_out, here, vec4f(next_film(here, n), 0.0, 0.0, 0.0));
  }
  storageBarrier();

  if (worker != 0u) { return; }
  var kept = 0u;
  for (var i = 0u; i < n; i++) {
    let d = drop_of(drops_out.records[i]);
    if (d.life <= 0.0) { continue; }
    drops_out.records[kept] = indexed(d, 0);
    kept++;
  }
  drops_out.count = kept;
}
