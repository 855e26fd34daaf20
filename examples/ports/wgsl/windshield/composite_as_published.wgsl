// windshield.composite, as-published. The scene through film and drops, with glints: linear radiance.
@group(0) @binding(2) var height: texture_2d<f32>;
@group(0) @binding(3) var normal: texture_2d<f32>;
@group(0) @binding(4) var mask: texture_2d<f32>;
@group(0) @binding(5) var<storage, read> glints: array<Glint>;
@group(0) @binding(18) var height_sampler: sampler;
@group(0) @binding(19) var normal_sampler: sampler;
@group(0) @binding(20) var mask_sampler: sampler;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let g = glass_point(vec2i(place.xy));
  let water = textureSampleLevel(normal, normal_sampler, g.uv, 0.0);
  let n = vec3f(water.xy, max(water.z, 0.05));
  let wet = 1.0 - clamp(textureSampleLevel(mask, mask_sampler, g.uv, 0.0).x, 0.0, 1.0);
  let visibility = shown(textureSampleLevel(height, height_sampler, g.uv, 0.0).x) * wet;
  let screen = scene_at(g.place);
  let offset = u.refraction * visibility * n.xy;
  let behind = behind_at(screen, 0.0);
  let blur = behind_at(screen, u.blur_lod);
  let sharp = behind_at(screen + offset, 0.0);
  var light = mix(mix(behind, blur, u.wetness * wet), sharp, visibility);
  let to_eye = -(1.0 / length(vec3f(g.place, 1.0))) * vec3f(g.place, 1.0);
  let facing = -to_camera(n);
  for (var k = 0; k < u.glint_count; k++) {
    light += highlight(facing, glints[k].direction, to_eye) * (u.glint_strength * visibility) * glints[k].radiance;
  }
  return vec4f(mix(u.cabin, light, g.on_glass), 1.0);
}
