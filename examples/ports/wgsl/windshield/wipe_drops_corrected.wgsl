// windshield.wipe_drops, corrected. Drops in the swept area ride on the blade, with the film that it sweeps.
// Whole mass units are integers here, so that sums are exact in any order. A record's index is its drop's place, a record of the
// wipers and a bin of it, until the water is handed on.
@group(0) @binding(3) var film: texture_2d<f32>;
struct DropsOutBuffer {
  count : atomic<u32>,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<IndexedDrop>,
}
@group(0) @binding(4) var<storage, read_write> drops_out: DropsOutBuffer;
@group(0) @binding(5) var film_out: texture_storage_2d<r32float, write>;

const most_places = 1024u;
const thrown_off = -2;
const most_mass = 1u << 24u;
// For each place: what the film gives, 64 bits of it, and the lowest id among the drops there.
var<workgroup> quanta_low: array<atomic<u32>, most_places>;
var<workgroup> quanta_high: array<atomic<u32>, most_places>;
var<workgroup> taker: array<atomic<u32>, most_places>;

fn in_sweep(w: Wiper, p: vec2f) -> bool {
  let r = p - w.pivot;
  let past_first = w.direction * (w.previous_axis.x * r.y - w.previous_axis.y * r.x);
  let past_last = w.direction * (w.axis.x * r.y - w.axis.y * r.x);
  let both = w.previous_axis + w.axis;
  let side = both.x * r.x + both.y * r.y;
  let radius_sq = r.x * r.x + r.y * r.y;
  let inner = w.inner_radius - w.half_width;
  let outer = w.outer_radius + w.half_width;
  let sector = past_first >= 0.0 && past_last <= 0.0 && side > 0.0 && radius_sq >= inner * inner && radius_sq <= outer * outer;
  return sector || under_blade(w, w.previous_axis, r) || under_blade(w, w.axis, r);
}
fn place_of(record: i32, p: vec2f) -> i32 {
  let w = wipers[record];
  let bins = f32(u.bin_count);
  let width = (w.outer_radius - w.inner_radius) + 2.0 * w.half_width;
  let first = w.inner_radius - w.half_width;
  return record * u.bin_count + i32(clamp(floor((length(p - w.pivot) - first) * (bins / width)), 0.0, bins - 1.0));
}

// A drop moved by the blades, with its place, or none, or thrown_off.
fn wiped(before: Drop) -> IndexedDrop {
  var d = before;
  var place = none;
  let base_radius = u.radius_scale * pow(max(d.mass, 0.0), 1.0 / 3.0);
  for (var i = 0; i < 2 * u.wiper_count; i++) {
    let record = i % u.wiper_count;
    let w = wipers[record];
    let p = to_plane(d.position);
    if (w.direction == 0.0 || !in_sweep(w, p)) { continue; }
    let radius = length(p - w.pivot);
    let s = min((w.half_width + base_radius) / max(radius, w.half_width), 1.0);
    let c = sqrt(max(1.0 - s * s, 0.0));
    let turned = w.direction * s;
    let r = radius * vec2f(c * w.axis.x - turned * w.axis.y, c * w.axis.y + turned * w.axis.x);
    d.position = to_glass(w.pivot + r);
    d.velocity = to_glass(w.rate * vec2f(-r.y, r.x));
    place = place_of(record, p);
  }
  let p = to_plane(d.position);
  for (var i = 0; i < u.wiper_count; i++) {
    if (wipers[i].direction != 0.0 && in_sweep(wipers[i], p)) { place = thrown_off; }
  }
  return indexed(d, place);
}
// What a blade sweeps off a texel of the film goes to its place; gives what is left.
fn swept(texel: vec2i) -> f32 {
  let here = textureLoad(film, texel, 0).x;
  let p = to_plane((vec2f(texel) + 0.5) * u.texel);
  for (var k = 0; k < u.wiper_count; k++) {
    if (wipers[k].direction == 0.0 || !in_sweep(wipers[k], p)) { continue; }
    let place = place_of(k, p);
    let water = u32(here);
    let before = atomicAdd(&quanta_low[place], water);
    if (before + water < before) { atomicAdd(&quanta_high[place], 1u); }
    return 0.0;
  }
  return here;
}

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  for (var i = worker; i < most_places; i += workers) { atomicStore(&taker[i], 0xffffffffu); }
  workgroupBarrier();

  for (var i = i32(worker); i < u.columns * u.rows; i += i32(workers)) {
    let texel = vec2i(i % u.columns, i / u.columns);
    textureStore(film_out, texel, vec4f(swept(texel), 0.0, 0.0, 0.0));
  }
  let room = arrayLength(&drops_out.records);
  for (var i = worker; i < arrayLength(&drops); i += workers) {
    if (drops[i].life <= 0.0) { continue; }
    let d = wiped(drops[i]);
    if (d.index == thrown_off) { continue; }
    if (d.index >= 0) { atomicMin(&taker[d.index], d.id); }
    let at = atomicAdd(&drops_out.count, 1u);
    if (at < room) { drops_out.records[at] = d; }
  }
  workgroupBarrier();
  storageBarrier();
  for (var i = worker; i < min(atomicLoad(&drops_out.count), room); i += workers) {
    let d = drops_out.records[i];
    drops_out.records[i].index = 0;
    if (d.index < 0 || atomicLoad(&taker[d.index]) != d.id) { continue; }
    let have = u32(d.mass);
    let free = most_mass - min(have, most_mass);
    let gained = select(min(atomicLoad(&quanta_low[d.index]), free), free, atomicLoad(&quanta_high[d.index]) > 0u);
    drops_out.records[i].mass = f32(have + gained);
  }
}
