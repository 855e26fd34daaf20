// Both variants of spawn: the drops of before and the step's arrivals.
struct SpawnUniforms {
  seed : vec2<u32>,       //   0  [1] Low and high word of the seed.
  step : u32,             //   8  [1] Steps made before this one, modulo 2^32.
  parts : u32,            //  12  [1] Draws that add up to the count.
  first_count : i32,      //  16  [1] Drops of a draw whose word is below every threshold.
  threshold_count : i32,  //  20  [1] Thresholds in the list; 0: each draw gives first_count.
  first_id : u32,         //  24  [1] Id of the first arrival; the others follow.
  room : u32,             //  28  [1] Free slots: arrivals beyond are lost.
  life : f32,             //  32  [s] Life of a new drop.
  padding_0 : f32,        //  36  padding
  padding_1 : f32,        //  40  padding
  padding_2 : f32,        //  44  padding
}
@group(0) @binding(0) var<uniform> u: SpawnUniforms;
struct SpawnMass {
  mass : f32,  //   0  [1] Mass of a size class of arrivals, as in Drop.
}

var<workgroup> arrivals: u32;

fn uniform_number(word: u32) -> f32 { return f32(word >> 8u) / 16777216.0; }

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  if (worker == 0u) {
    var drawn = 0u;
    for (var part = 0u; part < u.parts; part++) { drawn += u32(u.first_count) + above(random_block(5u, u.step, part).x); }
    arrivals = min(drawn, u.room);
  }
  workgroupBarrier();
  for (var i = worker; i < arrayLength(&drops); i += workers) {
    if (drops[i].life > 0.0) { append(drops[i]); }
  }
  for (var i = worker; i < arrivals; i += workers) {
    let r = random_block(6u, u.step, i);
    let place = vec2f(uniform_number(r.x), uniform_number(r.y));
    append(Drop(place, vec2f(0.0), spawn_masses[r.z >> 22u].mass, u.life, u.first_id + i, 0.0));
  }
}
