// windshield.interior, corrected. Pillar and dashboard before the glass, over what is seen through it.
struct InteriorUniforms {
  light : f32,      //   0  [1] Radiance of what is 1 in the interior's picture.
  padding_0 : f32,  //   4  padding
  padding_1 : f32,  //   8  padding
  padding_2 : f32,  //  12  padding
}
@group(0) @binding(0) var<uniform> u: InteriorUniforms;
@group(0) @binding(1) var interior: texture_2d<f32>;
@group(0) @binding(2) var colour: texture_2d<f32>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let inside = textureLoad(interior, pixel, 0);
  return vec4f(u.light * inside.rgb + (1.0 - inside.a) * textureLoad(colour, pixel, 0).rgb, 1.0);
}
