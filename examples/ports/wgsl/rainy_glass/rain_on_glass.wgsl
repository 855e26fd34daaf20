// What both versions of rain_on_glass share.
struct RainOnGlassUniforms {
  pixel : vec2<f32>,         //   0  [1] 1 over the picture's columns and rows.
  time : f32,                //   8  [s] as-published: frame number over frame rate, rounded once.
  rain_amount : f32,         //  12  [1] 1: every droplet shows.
  drop_tiles : f32,          //  16  [1/m] Tiles of the raindrop map in a metre.
  rivulet_tiles : f32,       //  20  [1/m] Tiles of the rivulet map in a metre.
  drop_rate : f32,           //  24  [1/s] as-published: cycles of a droplet in a second.
  flow_rate : f32,           //  28  [1/s] as-published: cycles of the flow in a second.
  flow_strength : f32,       //  32  [1] Tiles by which full flow moves a rivulet in a cycle; corrected: across.
  distortion : f32,          //  36  [1] as-published: pictures per unit of the summed channels.
  use_probe : i32,           //  40  [1] 1: the reflection probe, 0: the scene's picture.
  probe_level : f32,         //  44  [1] Mip level of the probe.
  drop_phase : f32,          //  48  [1] corrected: fraction of the droplets' cycle.
  flow_phase : f32,          //  52  [1] corrected: fraction of the flow's cycle.
  scroll : f32,              //  56  [1] Way of the rivulets down the glass, fraction of a tile.
  run_strength : f32,        //  60  [1] corrected: tiles by which full flow moves a rivulet along the glass in a cycle.
  drop_neutral : f32,        //  64  [1] corrected: stored value of 0 in the raindrop map.
  drop_scale : f32,          //  68  [1] corrected: normal over stored value less neutral.
  rivulet_neutral : f32,     //  72  [1] corrected: stored value of 0 in the rivulet map.
  rivulet_scale : f32,       //  76  [1] corrected: as drop_scale.
  sharpness : f32,           //  80  [1] corrected: 1 over the height in which a rim turns visible.
  impact : f32,              //  84  [1] corrected: share of the cycle in which a droplet spreads.
  bend : f32,                //  88  [1] corrected: refractive index of water less 1.
  rivulet_amount : f32,      //  92  [1] Weight of the rivulets.
  rain_to : vec3<f32>,       //  96  [1] corrected: its product with the normal is the share of the rain that the glass meets.
  padding_0 : f32,           // 108  padding
  right : vec3<f32>,         // 112  [1] Unit vector to the right of the picture, world.
  half_width : f32,          // 124  [1] Half the width of the image plane at distance 1.
  up : vec3<f32>,            // 128  [1] Unit vector to the top of the picture.
  half_height : f32,         // 140  [1] Half the height of the image plane at distance 1.
  forward : vec3<f32>,       // 144  [1] Unit vector into the picture.
  padding_1 : f32,           // 156  padding
  turn : vec2<f32>,          // 160  [1] as-published: cosine and sine of the turn of the raindrop map.
  rivulet_turn : vec2<f32>,  // 168  [1] as-published: the same of the rivulet map.
  flow_from : vec2<f32>,     // 176  [1] as-published: flow across and along that the stored value 0 stands for.
  flow_span : vec2<f32>,     // 184  [1] as-published: flow that 1 stands for, less flow_from.
  tint : vec3<f32>,          // 192  [1] as-published: factor of the radiance behind the glass.
  fade_rate : f32,           // 204  [1] as-published: 1 over the range of |n.y| in which rivulets fade.
  remap_first : i32,         // 208  [1] as-published: 1: channels are remapped to [-1, 1] before the mask, 0: their sum is.
  signed_offset : i32,       // 212  [1] as-published: 1: the timer takes 2 B - 1, 0: B.
  squared_weight : i32,      // 216  [1] as-published: 1: the second phase weighs the square of |1 - 2 p|, 0: that.
  padding_2 : f32,           // 220  padding
}
@group(0) @binding(0) var<uniform> u: RainOnGlassUniforms;
@group(0) @binding(1) var surface: texture_2d<f32>;
@group(0) @binding(2) var orientation: texture_2d<f32>;
@group(0) @binding(3) var raindrops: texture_2d<f32>;
@group(0) @binding(4) var rivulets: texture_2d<f32>;
@group(0) @binding(5) var scene: texture_2d<f32>;
@group(0) @binding(19) var raindrops_sampler: sampler;
@group(0) @binding(20) var rivulets_sampler: sampler;
@group(0) @binding(21) var scene_sampler: sampler;

fn probe_at(plane: vec2f) -> vec3f {
  let pi = 3.14159265358979;
  let d = u.forward + plane.x * u.right + plane.y * u.up;
  let at = vec2f(0.5 + atan2(d.z, d.x) / (2.0 * pi), 0.5 + atan2(d.y, length(d.xz)) / pi);
  return textureSampleLevel(probe, probe_sampler, at, u.probe_level).rgb;
}
fn scene_at(at: vec2f) -> vec3f { return textureSampleLevel(scene, scene_sampler, at, 0.0).rgb; }
fn raindrops_at(at: vec2f) -> vec4f { return textureSampleLevel(raindrops, raindrops_sampler, at, 0.0); }
fn rivulets_at(at: vec2f) -> vec4f { return textureSampleLevel(rivulets, rivulets_sampler, at, 0.0); }
// First phase, second phase, weight of the second.
fn flow_phases(phase: f32) -> vec3f {
  let first = fract(phase);
  return vec3f(first, fract(phase + 0.5), abs(1.0 - 2.0 * first));
}
