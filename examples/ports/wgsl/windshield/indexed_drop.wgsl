// A drop whose padding holds an index while a pass runs; 0 in the end.
struct IndexedDrop {
  position : vec2f,
  velocity : vec2f,
  mass : f32,
  life : f32,
  id : u32,
  index : i32,
}
const none = -1;
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

fn indexed(d: Drop, index: i32) -> IndexedDrop { return IndexedDrop(d.position, d.velocity, d.mass, d.life, d.id, index); }
fn drop_of(d: IndexedDrop) -> Drop { return Drop(d.position, d.velocity, d.mass, d.life, d.id, 0.0); }
