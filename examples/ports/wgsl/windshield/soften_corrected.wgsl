// windshield.soften, corrected. What composite made of the scene, drawn out across the streaks of the film that blades left.
struct SoftenUniforms {
  u_row : vec3<f32>,        //   0  [1] u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y).
  glass_distance : f32,     //  12  [m] As composite's.
  v_row : vec3<f32>,        //  16  [1] v likewise.
  lod : f32,                //  28  [1] Mip level of the lookups.
  w_row : vec3<f32>,        //  32  [1] See u_row; positive where the glass lies before the eye.
  most : f32,               //  44  [1] Share of the light that the thickest streak scatters.
  plane_x : vec3<f32>,      //  48  [1] First axis of the glass's plane, camera axes: right, up, forward.
  deflection_count : i32,   //  60  [1] Deflections in the list.
  plane_y : vec3<f32>,      //  64  [1] Second axis.
  padding_0 : f32,          //  76  padding
  pixel : vec2<f32>,        //  80  [1] Extent of a pixel on the image plane at distance 1.
  half_size : vec2<f32>,    //  88  [1] Half the extent of the image plane at distance 1.
  scene_scale : vec2<f32>,  //  96  [1] Texture coordinates of the scene per unit of the image plane.
  padding_1 : f32,          // 104  padding
  padding_2 : f32,          // 108  padding
}
struct Deflection {
  tangent : f32,    //   0  [1] Of the angle, along the blade that left the film.
  weight : f32,     //   4  [1] Share of the scattered light.
  padding_0 : f32,  //   8  padding
  padding_1 : f32,  //  12  padding
}
@group(0) @binding(0) var<uniform> u: SoftenUniforms;
@group(0) @binding(1) var blurred: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> deflections: array<Deflection>;
@group(0) @binding(3) var smear: texture_2d<f32>;
@group(0) @binding(4) var colour: texture_2d<f32>;
@group(0) @binding(17) var blurred_sampler: sampler;
@group(0) @binding(19) var smear_sampler: sampler;

@fragment
fn main(@builtin(position) position: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(position.xy);
  let q = vec3f(vec2f(pixel) + 0.5, 1.0);
  let toward = dot(u.w_row, q);
  let uv = vec2f(dot(u.u_row, q), dot(u.v_row, q)) * (1.0 / max(toward, 1e-6));
  let on_glass = toward > 1e-6 && all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
  let film = textureSampleLevel(smear, smear_sampler, clamp(uv, vec2f(0.0), vec2f(1.0)), 0.0).xyz;
  let share = select(0.0, u.most * film.z, on_glass);
  let place = q.xy * u.pixel - u.half_size;
  let at = 0.5 + place * u.scene_scale;
  let along = film.x * u.plane_x + film.y * u.plane_y;
  let turned = (along.xy - place * along.z) * u.scene_scale;
  var seen = textureLoad(colour, pixel, 0).rgb;
  if (share > 0.0) {
    var sum = vec3f(0.0);
    for (var k = 0; k < u.deflection_count; k++) {
      sum += deflections[k].weight * textureSampleLevel(blurred, blurred_sampler, at + deflections[k].tangent * turned, u.lod).rgb;
    }
    seen = mix(seen, sum, share);
  }
  return vec4f(seen, 1.0);
}
