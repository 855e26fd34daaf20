// windshield.persist, as-published. This frame's drops over what is left of the height texture of the frame before.
struct PersistUniforms {
  keep : f32,       //   0  [1] Share of the height that a frame leaves.
  padding_0 : f32,  //   4  padding
  padding_1 : f32,  //   8  padding
  padding_2 : f32,  //  12  padding
}
@group(0) @binding(0) var<uniform> u: PersistUniforms;
@group(0) @binding(1) var height: texture_2d<f32>;
@group(0) @binding(2) var previous_height: texture_2d<f32>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  let drawn = textureLoad(height, texel, 0).x;
  let left = textureLoad(previous_height, texel, 0).x * u.keep;
  return vec4f(max(drawn, left), 0.0, 0.0, 0.0);
}
