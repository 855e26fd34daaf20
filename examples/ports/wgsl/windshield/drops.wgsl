// What the passes that give lists of drops share: one workgroup takes the list; the order of what it gives is free.
const workers = 64u;
struct Drop {
  position : vec2<f32>,  //   0  [1] Glass coordinates u, v.
  velocity : vec2<f32>,  //   8  [1/s] Change of the position.
  mass : f32,            //  16  [1] as-published: 1 is an ordinary drop; corrected: whole mass units of 2e-11 kg, at most 2^24.
  life : f32,            //  20  [s] What remains; not above 0: no drop.
  id : u32,              //  24  [1] Its own for ever, ascending in the order of birth.
  padding_0 : f32,       //  28  padding
}
@group(0) @binding(1) var<storage, read> drops: array<Drop>;

struct DropsOutBuffer {
  count : atomic<u32>,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<Drop>,
}
// The buffer may be too short for a wrong port; the count says so.
fn append(drop: Drop) {
  let at = atomicAdd(&drops_out.count, 1u);
  if (at < arrayLength(&drops_out.records)) { drops_out.records[at] = drop; }
}
