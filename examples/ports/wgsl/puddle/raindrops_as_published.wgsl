// puddle.raindrops, as-published. The drops that fall in this step: one workgroup draws them all, record i is drop i.
struct RaindropsUniforms {
  time : f32,            //   0  [s] Frame number over frame rate, rounded once.
  rain_speed : f32,      //   4  [1/s] Pulses of each drop a second.
  drop_intensity : f32,  //   8  [1] Strength of an impact.
  padding_0 : f32,       //  12  padding
  width : f32,           //  16  [texel] Columns of the wave.
  height : f32,          //  20  [texel] Rows of the wave.
  drop_count : i32,      //  24  [1] Drops in the list.
  padding_1 : f32,       //  28  padding
}
@group(0) @binding(0) var<uniform> u: RaindropsUniforms;
struct DropsBuffer {
  count : u32,
  padding_0 : u32,
  padding_1 : u32,
  padding_2 : u32,
  records : array<Drop>,
}
@group(0) @binding(1) var<storage, read_write> drops: DropsBuffer;

// q of both hashes.
fn spread(at: vec2f, scale: vec3f) -> vec3f {
  let p = fract(at.xyx * scale);
  return p + dot(p, p.yzx + 33.33);
}
fn hash22(at: vec2f) -> vec2f {
  let q = spread(at, vec3f(0.1031, 0.1030, 0.0973));
  return fract(vec2f((q.x + q.y) * q.z, (q.x + q.z) * q.y));
}
fn hash12(at: vec2f) -> f32 {
  let q = spread(at, vec3f(0.1031));
  return fract((q.x + q.y) * q.z);
}
// smoothstep with falling edges, for which WGSL gives no value.
fn falling(start: f32, end: f32, x: f32) -> f32 {
  let t = clamp((x - start) / (end - start), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

@compute @workgroup_size(64)
fn main(@builtin(local_invocation_index) worker: u32) {
  if (worker == 0u) { drops.count = u32(u.drop_count); }
  let t = u.time * u.rain_speed;
  for (var i = i32(worker); i < u.drop_count; i += 64) {
    let offset = f32(i) * 0.3711;
    let seed = vec2f(floor(t) + offset, f32(i) * 17.3);
    let place = hash22(seed);
    let strength = u.drop_intensity * (0.5 + 0.5 * hash12(seed + 1.0));
    let pulse = fract(t + offset * 0.7);
    let activation = smoothstep(0.0, 0.15, pulse) * falling(0.35, 0.2, pulse);
    drops.records[i] = Drop(place.x * u.width, place.y * u.height, strength * activation, 4.0);
  }
}
