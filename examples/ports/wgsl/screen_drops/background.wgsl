// What both backgrounds share.
struct BackgroundUniforms {
  resolution : vec2<f32>,  //   0  [pixel] as-published: columns and rows of the picture.
  level : f32,             //   8  [1] Mip level of the lookups.
  weight : f32,            //  12  [1] corrected: of a tap.
  scale : vec2<f32>,       //  16  [1] corrected: texture coordinates of the scene in a pixel.
  offset : vec2<f32>,      //  24  [1] corrected: those of the picture's corner.
  tap_count : i32,         //  32  [1] corrected: taps in the list.
  padding_0 : f32,         //  36  padding
  padding_1 : f32,         //  40  padding
  padding_2 : f32,         //  44  padding
}
@group(0) @binding(0) var<uniform> u: BackgroundUniforms;
@group(0) @binding(1) var scene: texture_2d<f32>;
@group(0) @binding(17) var scene_sampler: sampler;
