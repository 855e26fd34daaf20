// What both composites share.
struct Glint {
  direction : vec3<f32>,  //   0  [1] Unit, toward the light, camera axes: right, up, forward.
  padding_0 : f32,        //  12  padding
  radiance : vec3<f32>,   //  16  [1] Linear RGB.
  padding_1 : f32,        //  28  padding
}
@group(0) @binding(1) var blurred: texture_2d<f32>;
@group(0) @binding(17) var blurred_sampler: sampler;

fn scene_at(place: vec2f) -> vec2f { return 0.5 + place * u.scene_scale; }
fn behind_at(at: vec2f, level: f32) -> vec3f { return textureSampleLevel(blurred, blurred_sampler, at, level).rgb; }

fn to_camera(glass: vec3f) -> vec3f { return glass.x * u.plane_x + glass.y * u.plane_y + glass.z * u.outward; }

fn shown(height: f32) -> f32 {
  let t = clamp((height - u.visible_from) / (u.visible_to - u.visible_from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

fn highlight(normal: vec3f, to_light: vec3f, to_eye: vec3f) -> f32 {
  let sum = to_light + to_eye;
  let cosine = clamp(dot(normal, sum) / max(length(sum), 1e-4), 0.0, 1.0);
  return pow(max(cosine, 1e-4), u.shininess);
}
