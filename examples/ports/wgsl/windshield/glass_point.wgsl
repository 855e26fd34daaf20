// Where a pixel's view ray meets the glass.
struct CompositeUniforms {
  u_row : vec3<f32>,        //   0  [1] u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y).
  glass_distance : f32,     //  12  [m] The glass lies glass_distance / w_row . (x, y, 1) along the view axis.
  v_row : vec3<f32>,        //  16  [1] v likewise.
  blur_lod : f32,           //  28  [1] Mip level of the picture behind the film.
  w_row : vec3<f32>,        //  32  [1] See u_row; positive where the glass lies before the eye.
  wetness : f32,            //  44  [1] Weight of the blurred picture where the glass was not wiped.
  plane_x : vec3<f32>,      //  48  [1] First axis of the glass's plane, camera axes: right, up, forward.
  visible_from : f32,       //  60  [mm] Height at which water begins to show as a drop.
  plane_y : vec3<f32>,      //  64  [1] Second axis.
  visible_to : f32,         //  76  [mm] Height from which it shows fully.
  outward : vec3<f32>,      //  80  [1] Normal of the glass, away from the car.
  refraction : f32,         //  92  [1] as-published: offset in pictures per unit of n.xy.
  pixel : vec2<f32>,        //  96  [1] Extent of a pixel on the image plane at distance 1.
  half_size : vec2<f32>,    // 104  [1] Half the extent of the image plane at distance 1.
  scene_scale : vec2<f32>,  // 112  [1] Texture coordinates of the scene per unit of the image plane.
  shininess : f32,          // 120  [1] Power of a highlight.
  glint_strength : f32,     // 124  [1] Weight of the highlights.
  cabin : vec3<f32>,        // 128  [1] Radiance beside the glass.
  glint_count : i32,        // 140  [1] Lights in the list.
  water_ior : f32,          // 144  [1] corrected: refractive index of the water.
  inner : f32,              // 148  [1] corrected: share of the blurred scene that the water's surface mirrors.
  padding_0 : f32,          // 152  padding
  padding_1 : f32,          // 156  padding
}
@group(0) @binding(0) var<uniform> u: CompositeUniforms;

struct GlassPoint {
  place : vec2f,  // on the image plane at distance 1
  distance : f32,  // along the view axis to the glass [m]
  uv : vec2f,
  on_glass : f32,
}
fn glass_point(pixel: vec2i) -> GlassPoint {
  let at = vec3f(vec2f(pixel) + 0.5, 1.0);
  let toward = dot(u.w_row, at);
  let inverse = 1.0 / max(toward, 1e-6);
  let uv = vec2f(dot(u.u_row, at), dot(u.v_row, at)) * inverse;
  let on = toward > 1e-6 && all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
  return GlassPoint(at.xy * u.pixel - u.half_size, u.glass_distance * inverse, clamp(uv, vec2f(0.0), vec2f(1.0)), select(0.0, 1.0, on));
}
