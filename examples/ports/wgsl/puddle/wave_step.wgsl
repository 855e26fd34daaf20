// What both wave_steps share.
override wave_address_u: i32;  // 0 clamp, 1 repeat, 2 border
struct WaveStepUniforms {
  damping : f32,      //   0  [1] as-published: factor of the new level; corrected: gamma of a step.
  step : f32,         //   4  [texel] as-published: offset of the neighbours.
  courant_sq : f32,   //   8  [1] corrected: Courant number squared, times (1 + gamma) / 2.
  drop_count : i32,   //  12  [1] Drops in the list.
  rest : f32,         //  16  [1] Stored value of level water.
  rim_damping : f32,  //  20  [1] corrected: share of the wave that the rim takes at the edge itself.
  rim_inverse : f32,  //  24  [1/texel] corrected: one over the width of the rim.
  padding_0 : f32,    //  28  padding
  size : vec2<f32>,   //  32  [texel] corrected: columns and rows of the wave.
  padding_1 : f32,    //  40  padding
  padding_2 : f32,    //  44  padding
}
@group(0) @binding(0) var<uniform> u: WaveStepUniforms;
@group(0) @binding(1) var wave: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> drops: array<Drop>;

// A texel of the wave by the address rule of its boundary; (newest, previous).
fn wave_texel(at: vec2i) -> vec2f {
  let size = vec2i(textureDimensions(wave));
  var texel = at;
  // Not by %, which takes the sign of the dividend.
  if (wave_address_u == 1) { texel -= size * vec2i(floor(vec2f(at) / vec2f(size))); }
  if (wave_address_u == 2 && (any(at < vec2i(0)) || any(at >= size))) { return vec2f(u.rest); }
  return textureLoad(wave, clamp(texel, vec2i(0), size - 1), 0).xy;
}
