// puddle.raindrops, corrected. The drops that fall in this step: one invocation draws them, because their order is part of the result.
struct RainfallUniforms {
  seed : vec2<u32>,       //   0  [1] Low and high word of the seed.
  step : u32,             //   8  [1] Wave steps made before this one, modulo 2^32.
  first_count : i32,      //  12  [1] Drops where the word is below every threshold.
  columns : u32,          //  16  [texel] Columns of the wave.
  rows : u32,             //  20  [texel] Rows of the wave.
  boundary : i32,         //  24  [1] 0: reflecting, 1: periodic, 2: fixed.
  threshold_count : i32,  //  28  [1] Thresholds in the list.
  shelter_columns : u32,  //  32  [1] Columns of the shelter; 0: there is none.
  shelter_rows : u32,     //  36  [1] Its rows.
  object_count : i32,     //  40  [1] Records of objects in the list.
  padding_0 : f32,        //  44  padding
}
@group(0) @binding(0) var<uniform> u: RainfallUniforms;
struct CountThreshold {
  threshold : u32,  //   0  [1] A word not below k thresholds draws first_count + k drops.
}
@group(0) @binding(1) var<storage, read> craters: array<Drop>;
@group(0) @binding(2) var<storage, read> count_thresholds: array<CountThreshold>;
struct ShelterCell {
  open : u32,  //   0  [1] Of 65536 drops over this cell so many fall.
}
@group(0) @binding(3) var<storage, read> shelter: array<ShelterCell>;
@group(0) @binding(4) var<storage, read> objects: array<Drop>;
struct DropsBuffer {
  count : u32,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<Drop>,
}
@group(0) @binding(5) var<storage, read_write> drops: DropsBuffer;

// The buffer may be too short for a wrong port; the count says so.
fn append(drop: Drop) {
  if (drops.count < arrayLength(&drops.records)) { drops.records[drops.count] = drop; }
  drops.count++;
}
// Only the images of a crater that reach into the rectangle count.
fn reaches(at: f32, radius: f32, size: u32) -> bool { return at + radius > 0.0 && at - radius < f32(size); }

// Whether no roof keeps the drop of these words off.
fn falls(r: vec4u) -> bool {
  if (u.shelter_columns == 0u) { return true; }
  let column = ((r.x >> 16u) * u.shelter_columns) >> 16u;
  let row = ((r.y >> 16u) * u.shelter_rows) >> 16u;
  return (r.w >> 16u) < shelter[row * u.shelter_columns + column].open;
}

@compute @workgroup_size(1)
fn main() {
  let word = random_block(1u, u.step, 0u).x;
  var drawn = u.first_count;
  for (var i = 0; i < u.threshold_count; i++) {
    if (word >= count_thresholds[i].threshold) { drawn++; }
  }

  drops.count = 0u;
  for (var i = 0; i < drawn; i++) {
    let r = random_block(2u, u.step, u32(i));
    if (!falls(r)) { continue; }
    var drop = craters[r.z >> 22u];
    drop.x = f32(((r.x >> 16u) * u.columns) >> 8u) / 256.0;
    drop.y = f32(((r.y >> 16u) * u.rows) >> 8u) / 256.0;
    append(drop);
    if (u.boundary == 2) { continue; }
    let size = vec2f(f32(u.columns), f32(u.rows));
    let place = vec2f(drop.x, drop.y);
    let is_periodic = u.boundary == 1;
    let below = select(-place, place - size, is_periodic);
    let above = select(2.0 * size - place, place + size, is_periodic);
    let xs = array<f32, 3>(place.x, below.x, above.x);
    let ys = array<f32, 3>(place.y, below.y, above.y);
    for (var j = 0; j < 3; j++) {
      for (var k = 0; k < 3; k++) {
        if (j == 0 && k == 0) { continue; }
        if (reaches(xs[k], drop.radius, u.columns) && reaches(ys[j], drop.radius, u.rows)) {
          append(Drop(xs[k], ys[j], drop.amplitude, drop.radius));
        }
      }
    }
  }
  for (var i = 0; i < u.object_count; i++) { append(objects[i]); }
}
