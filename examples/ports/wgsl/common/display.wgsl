// display of windshield, edge_splash, screen_drops and rainy_glass, as-published and corrected. Display code.
struct DisplayUniforms {
  exposure : f32,   //   0  [1] Factor of the radiance.
  padding_0 : f32,  //   4  padding
  padding_1 : f32,  //   8  padding
  padding_2 : f32,  //  12  padding
}
@group(0) @binding(0) var<uniform> u: DisplayUniforms;
@group(0) @binding(1) var colour: texture_2d<f32>;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let linear = clamp(u.exposure * textureLoad(colour, vec2i(place.xy), 0).rgb, vec3f(0.0), vec3f(1.0));
  return vec4f(encode_srgb(linear), 1.0);
}
