// Uniforms, input and outputs of both versions of surface_hit.
struct SurfaceHitUniforms {
  camera_position : vec3<f32>,  //   0  [m] Eye.
  camera_pixel_scale : f32,     //  12  [1] Height of a pixel on the image plane at distance 1.
  camera_right : vec3<f32>,     //  16  [1] Unit vector to the right of the picture.
  camera_plane_left : f32,      //  28  [1] Left edge of the image plane at distance 1.
  camera_up : vec3<f32>,        //  32  [1] Unit vector to the top of the picture.
  camera_plane_bottom : f32,    //  44  [1] Bottom edge of the image plane at distance 1.
  camera_forward : vec3<f32>,   //  48  [1] Unit vector into the picture.
  padding_0 : f32,              //  60  padding
  half_size : vec3<f32>,        //  64  [m] Half the puddle's extent.
  epsilon : f32,                //  76  [m] Distance that counts as a hit.
  texel : vec2<f32>,            //  80  [1] 1 over the wave's columns and rows.
  max_steps : i32,              //  88  [1] Most steps of the march.
  normal_gain : f32,            //  92  [1] Factor from a height difference to a slope.
  height_scale : f32,           //  96  [m] corrected: height = scale * stored + bias.
  height_bias : f32,            // 100  [m] corrected: see height_scale.
  surface_top : f32,            // 104  [m] corrected: no height lies above this, or below its negative.
  surface_slope : f32,          // 108  [1] corrected: no slope of the surface is above this.
  inverse_size : vec2<f32>,     // 112  [1/m] corrected: 1 over the puddle's extent in x and z.
  bounds_scale : vec2<f32>,     // 120  [1] corrected: texture coordinates of bounds to one of the water.
  bounds_reach : f32,           // 128  [m] corrected: a texel of bounds holds this far around its points.
  padding_1 : f32,              // 132  padding
  padding_2 : f32,              // 136  padding
  padding_3 : f32,              // 140  padding
}
@group(0) @binding(0) var<uniform> u: SurfaceHitUniforms;
@group(0) @binding(1) var wave: texture_2d<f32>;
@group(0) @binding(17) var wave_sampler: sampler;

struct Outputs {
  @location(0) hit: vec4f,
  @location(1) normal: vec4f,
}
