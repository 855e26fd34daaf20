// windshield.composite, corrected. The scene through film and drops, with glints: linear radiance.
@group(0) @binding(2) var scene_depth: texture_2d<f32>;
@group(0) @binding(3) var height: texture_2d<f32>;
@group(0) @binding(4) var normal: texture_2d<f32>;
@group(0) @binding(5) var mask: texture_2d<f32>;
@group(0) @binding(6) var<storage, read> glints: array<Glint>;
@group(0) @binding(18) var scene_depth_sampler: sampler;
@group(0) @binding(19) var height_sampler: sampler;
@group(0) @binding(20) var normal_sampler: sampler;
@group(0) @binding(21) var mask_sampler: sampler;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let g = glass_point(vec2i(place.xy));
  let water = textureSampleLevel(normal, normal_sampler, g.uv, 0.0);
  let n = vec3f(water.xy, max(water.z, 0.05));
  let m = clamp(textureSampleLevel(mask, mask_sampler, g.uv, 0.0).x, 0.0, 1.0);
  let wet = 1.0 - m;
  let visibility = shown(textureSampleLevel(height, height_sampler, g.uv, 0.0).x);

  let ray = normalize(vec3f(g.place, 1.0));
  let surface = to_camera(n);
  let inside = bend(ray, -u.outward, 1.0 / u.water_ior);
  let bent = bend(inside, -surface, u.water_ior);
  let reflected = fresnel(clamp(dot(bent, surface), 0.0, 1.0));

  let depth = max(textureSampleLevel(scene_depth, scene_depth_sampler, scene_at(g.place), 0.0).x - g.distance, 0.0);
  let ahead = max(bent.z, 0.05);
  let through = mix(bent.xy / ahead, g.place, g.distance / max(g.distance + depth, 1e-3));
  let at = scene_at(through);

  let sharp = behind_at(at, 0.0);
  let blur = behind_at(at, u.blur_lod);
  var light = mix(sharp, blur, u.wetness * wet * (1.0 - visibility));
  light = mix(light, u.inner * blur, reflected);
  let film = visibility * (1.0 - m * m);
  for (var k = 0; k < u.glint_count; k++) {
    light += highlight(-surface, glints[k].direction, -ray) * (u.glint_strength * film) * glints[k].radiance;
  }
  return vec4f(mix(u.cabin, light, g.on_glass), 1.0);
}
