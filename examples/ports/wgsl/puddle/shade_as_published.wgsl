// puddle.shade, as-published. Reflection, refraction, water and ground: linear radiance.
@group(0) @binding(3) var noise: texture_2d<f32>;
@group(0) @binding(4) var environment: texture_2d<f32>;
@group(0) @binding(5) var ground: texture_2d<f32>;
@group(0) @binding(20) var environment_sampler: sampler;
@group(0) @binding(21) var ground_sampler: sampler;

fn decode(code: vec3f) -> vec3f { return pow(code, vec3f(2.2)); }

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let pixel = vec2i(place.xy);
  let p = textureLoad(hit_image, pixel, 0).xyz;
  let view = view_ray(pixel);
  let surface = textureLoad(normal_image, pixel, 0);
  let normal = surface.xyz;
  let hit = surface.w > 0.5;
  let reflected = decode(sample_environment(select(view, reflect(view, normal), hit), 0.0));
  if (!hit) { return vec4f(reflected, 1.0); }

  let cosine = min(abs(dot(view, normal)), 1.0);
  let fresnel = schlick(cosine);
  let bent = refract(view, normal, 1.0 / water_ior);
  var t = -1.0;
  if (abs(bent.y) >= 0.0001) { t = (-u.puddle_depth - p.y) / bent.y; }
  var below = 0.3 * u.tint;
  if (t > 0.0) {
    let at = p.xz + t * bent.xz;
    var base: vec3f;
    if (u.use_checkerboard != 0) {
      base = checkerboard(at) + (textureLoad(noise, pixel, 0).x - 0.5) * 0.05;
    } else {
      base = 0.6 * decode(textureSampleLevel(ground, ground_sampler, at * u.ground_scale, 0.0).rgb);
    }
    below = 0.7 * (1.0 - 0.5 * u.tint) * mix(u.tint, base, transmittance(u.water_turbidity, t));
  }

  let weight = fresnel * (mix(0.3, 0.8, u.reflectivity) - 0.3) + 0.3;
  let light = mix(below, reflected, weight) + 0.15 * (1.0 - fresnel) * u.tint;
  let fog = transmittance(u.fog_depth, distance(p, u.camera_position));
  return vec4f(mix(0.7 * light, light, fog), 1.0);
}
