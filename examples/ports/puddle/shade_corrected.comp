// puddle.shade, corrected. Reflection, refraction, water and ground: linear radiance.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(binding = 1) uniform sampler2D hit_image;
layout(binding = 2) uniform sampler2D normal_image;
layout(binding = 3) uniform sampler2D environment;
layout(binding = 4) uniform sampler2D ground;
layout(binding = 5) uniform sampler2D relief;
layout(binding = 6) uniform sampler2D bed;
layout(binding = 7) uniform writeonly image2D colour;
#include "shade.glsl"
#include "camera.glsl"

float fresnel_exact(float cos_i) {
  float eta = WATER_IOR, cos_t = sqrt(max(1.0 - (1.0 - cos_i * cos_i) / (eta * eta), 0.0));
  float parallel = (eta * cos_i - cos_t) / max(eta * cos_i + cos_t, 1e-20);
  float perpendicular = (cos_i - eta * cos_t) / max(cos_i + eta * cos_t, 1e-20);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// Nearest level of x texels to a pixel: floor(log2(x) + 1/2), by comparison with sqrt(2), 2 sqrt(2), ...
float nearest_octave(float x) {
  float level = 0.0, threshold = 1.41421354;
  for (int i = 0; i < 12; ++i, threshold *= 2.0) level += x >= threshold ? 1.0 : 0.0;
  return level;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec3 p = texelFetch(hit_image, pixel, 0).xyz, view = view_ray(pixel);
  vec4 surface = texelFetch(normal_image, pixel, 0);
  if (surface.w <= 0.5) {
    imageStore(colour, pixel, vec4(sample_environment(view, u.background_level), 1.0));
    return;
  }

  float depth = textureLod(bed, p.xz * u.inverse_size + 0.5, 0.0).x;
  float water = smoothstep(0.0, u.shore_width, depth);
  float away = distance(p, u.camera_position);
  float lod = nearest_octave(u.ground_footprint * away / max(-view.y, 0.02));
  vec3 normal = surface.xyz;
  if (water < 1.0) {
    vec2 tilt = textureLod(relief, p.xz * u.ground_scale, lod).xy;
    normal = normalize(mix(vec3(tilt.x, 1.0, tilt.y), surface.xyz, water));
  }

  float cosine = clamp(-dot(view, normal), 1e-3, 1.0);
  float fresnel = (u.exact_fresnel != 0 ? fresnel_exact(cosine) : schlick(cosine)) * u.reflectivity * mix(u.wetness, 1.0, water);
  vec3 mirrored = reflect(view, normal);
  mirrored.y = abs(mirrored.y);
  float gloss = mix(u.gloss_level, u.mirror_level, water);
  vec3 reflected = sample_environment(mirrored, gloss);

  vec3 bent = refract(view, normal, 1.0 / WATER_IOR);
  float column = max(depth, 0.0), path = column / max(-bent.y, 0.05);
  vec2 place = p.xz + path * bent.xz;
  vec3 albedo;
  if (u.use_checkerboard != 0) {
    albedo = checkerboard(place);
  } else {
    vec2 tile = place * u.ground_scale;
    albedo = textureLod(ground, tile, lod).rgb;
  }
  float way = path + column;
  if (column > 0.0) albedo = mix(u.tint, albedo, transmittance(u.water_turbidity, way));
  vec3 body = albedo * u.ambient;
  vec3 light = fresnel * reflected + (1.0 - fresnel) * body;
  if (u.fog_depth > 0.0) light = mix(u.fog_colour, light, transmittance(u.fog_depth, away));
  if (u.ground_reach > 0.0) {
    vec2 out_of_it = max(abs(p.xz * u.inverse_size) - 0.5, vec2(0.0));
    float own = smoothstep(0.0, u.ground_reach, length(out_of_it));
    float sharp = u.background_level;
    if (own > 0.0) light = mix(light, sample_environment(view, sharp), own);
  }
  imageStore(colour, pixel, vec4(light, 1.0));
}
