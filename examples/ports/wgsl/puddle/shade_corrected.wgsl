// puddle.shade, corrected. Reflection, refraction, water and ground: linear radiance.
override bed_border: f32;
@group(0) @binding(3) var environment: texture_2d<f32>;
@group(0) @binding(4) var ground: texture_2d<f32>;
@group(0) @binding(5) var relief: texture_2d<f32>;
@group(0) @binding(6) var bed: texture_2d<f32>;
@group(0) @binding(19) var environment_sampler: sampler;
@group(0) @binding(20) var ground_sampler: sampler;
@group(0) @binding(21) var relief_sampler: sampler;

fn fresnel_exact(cos_i: f32) -> f32 {
  let eta = water_ior;
  let cos_t = sqrt(max(1.0 - (1.0 - cos_i * cos_i) / (eta * eta), 0.0));
  let parallel = (eta * cos_i - cos_t) / max(eta * cos_i + cos_t, 1e-20);
  let perpendicular = (cos_i - eta * cos_t) / max(cos_i + eta * cos_t, 1e-20);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// Nearest level of x texels to a pixel: floor(log2(x) + 1/2), by comparison with sqrt(2), 2 sqrt(2), ...
fn nearest_octave(x: f32) -> f32 {
  var level = 0.0;
  var threshold = 1.41421354;
  for (var i = 0; i < 12; i++) {
    level += select(0.0, 1.0, x >= threshold);
    threshold *= 2.0;
  }
  return level;
}

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let p = textureLoad(hit_image, pixel, 0).xyz;
  let view = view_ray(pixel);
  let surface = textureLoad(normal_image, pixel, 0);
  if (surface.w <= 0.5) { return vec4f(sample_environment(view, u.background_level), 1.0); }

  let depth = bilinear_with_border(bed, p.xz * u.inverse_size + 0.5, bed_border);
  let water = smoothstep(0.0, u.shore_width, depth);
  let away = distance(p, u.camera_position);
  let lod = nearest_octave(u.ground_footprint * away / max(-view.y, 0.02));
  var normal = surface.xyz;
  if (water < 1.0) {
    let tilt = textureSampleLevel(relief, relief_sampler, p.xz * u.ground_scale, lod).xy;
    normal = normalize(mix(vec3f(tilt.x, 1.0, tilt.y), surface.xyz, water));
  }

  let cosine = clamp(-dot(view, normal), 1e-3, 1.0);
  var fresnel = schlick(cosine);
  if (u.exact_fresnel != 0) { fresnel = fresnel_exact(cosine); }
  fresnel = fresnel * u.reflectivity * mix(u.wetness, 1.0, water);
  var mirrored = reflect(view, normal);
  mirrored.y = abs(mirrored.y);
  let gloss = mix(u.gloss_level, u.mirror_level, water);
  let reflected = sample_environment(mirrored, gloss);

  let bent = refract(view, normal, 1.0 / water_ior);
  let column = max(depth, 0.0);
  let path = column / max(-bent.y, 0.05);
  let at = p.xz + path * bent.xz;
  var albedo: vec3f;
  if (u.use_checkerboard != 0) {
    albedo = checkerboard(at);
  } else {
    albedo = textureSampleLevel(ground, ground_sampler, at * u.ground_scale, lod).rgb;
  }
  if (column > 0.0) { albedo = mix(u.tint, albedo, transmittance(u.water_turbidity, path + column)); }
  let body = albedo * u.ambient;
  var light = fresnel * reflected + (1.0 - fresnel) * body;
  if (u.fog_depth > 0.0) { light = mix(u.fog_colour, light, transmittance(u.fog_depth, away)); }
  if (u.ground_reach > 0.0) {
    let out_of_it = max(abs(p.xz * u.inverse_size) - 0.5, vec2f(0.0));
    let own = smoothstep(0.0, u.ground_reach, length(out_of_it));
    if (own > 0.0) { light = mix(light, sample_environment(view, u.background_level), own); }
  }
  return vec4f(light, 1.0);
}
