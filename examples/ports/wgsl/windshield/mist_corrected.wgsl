// windshield.mist, corrected. What composite made of the scene, and through the mist on the glass a blurred and veiled one.
struct MistUniforms {
  u_row : vec3<f32>,        //   0  [1] u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y).
  glass_distance : f32,     //  12  [m] As composite's.
  v_row : vec3<f32>,        //  16  [1] v likewise.
  lod : f32,                //  28  [1] Mip level of the lookups at the taps.
  w_row : vec3<f32>,        //  32  [1] See u_row; positive where the glass lies before the eye.
  veil : f32,               //  44  [1] Share of the light in the mist that comes from all the scene.
  pixel : vec2<f32>,        //  48  [1] Extent of a pixel on the image plane at distance 1.
  half_size : vec2<f32>,    //  56  [1] Half the extent of the image plane at distance 1.
  scene_scale : vec2<f32>,  //  64  [1] Texture coordinates of the scene per unit of the image plane.
  weight : f32,             //  72  [1] Of a tap.
  tap_count : i32,          //  76  [1] Taps in the list.
}
struct Tap {
  x : f32,          //   0  [1] From the pixel's place, in texture coordinates of the scene.
  y : f32,          //   4  [1] See x.
  padding_0 : f32,  //   8  padding
  padding_1 : f32,  //  12  padding
}
@group(0) @binding(0) var<uniform> u: MistUniforms;
@group(0) @binding(1) var blurred: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> taps: array<Tap>;
@group(0) @binding(3) var condensation: texture_2d<f32>;
@group(0) @binding(4) var colour: texture_2d<f32>;
@group(0) @binding(17) var blurred_sampler: sampler;
@group(0) @binding(19) var condensation_sampler: sampler;

const coarsest = 15.0;  // of every pyramid: a lookup goes no further than the last level

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let q = vec3f(vec2f(pixel) + 0.5, 1.0);
  let toward = dot(u.w_row, q);
  let uv = vec2f(dot(u.u_row, q), dot(u.v_row, q)) * (1.0 / max(toward, 1e-6));
  let on_glass = toward > 1e-6 && all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
  let at = 0.5 + (q.xy * u.pixel - u.half_size) * u.scene_scale;
  let share = textureSampleLevel(condensation, condensation_sampler, clamp(uv, vec2f(0.0), vec2f(1.0)), 0.0).x;
  var sum = vec3f(0.0);
  for (var k = 0; k < u.tap_count; k++) { sum += textureSampleLevel(blurred, blurred_sampler, at + vec2f(taps[k].x, taps[k].y), u.lod).rgb; }
  let blur = u.weight * sum;
  let veil = textureSampleLevel(blurred, blurred_sampler, at, coarsest).rgb;
  let before = textureLoad(colour, pixel, 0).rgb;
  return vec4f(mix(before, mix(blur, veil, u.veil), select(0.0, share, on_glass)), 1.0);
}
