// What both blur_pyramids share.
struct BlurUniforms {
  fog_colour : vec3<f32>,   //   0  [1] Linear radiance of the fog.
  fog_density : f32,        //  12  [1/m] Extinction of light in the fog.
  middle : vec2<f32>,       //  16  [1] corrected: weight of the middle one of three texels, for columns and rows.
  last : vec2<f32>,         //  24  [1] corrected: weight of the last one, over output index + 1.
  source_size : vec2<i32>,  //  32  [texel] Columns and rows of the level above.
  level : i32,              //  40  [1] 0 fogs the scene, further ones halve the level above.
  padding_0 : f32,          //  44  padding
}
@group(0) @binding(0) var<uniform> u: BlurUniforms;
@group(0) @binding(1) var scene_colour: texture_2d<f32>;
@group(0) @binding(2) var scene_depth: texture_2d<f32>;
@group(0) @binding(3) var blurred: texture_2d<f32>;  // the level above

fn fogged(texel: vec2i) -> vec4f {
  let depth = textureLoad(scene_depth, texel, 0).x;
  let seen = exp(-(u.fog_density * max(depth, 0.0)));
  return vec4f(mix(u.fog_colour, textureLoad(scene_colour, texel, 0).rgb, seen), 1.0);
}
fn tap(texel: vec2i, i: i32, j: i32) -> vec4f { return textureLoad(blurred, min(2 * texel + vec2i(i, j), u.source_size - 1), 0); }
