// windshield.composite, corrected. The scene through film and drops, with glints: linear radiance.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "composite.glsl"
layout(binding = 1) uniform sampler2D pyramid;
layout(binding = 2) uniform sampler2D scene_depth;
layout(binding = 3) uniform sampler2D heights;
layout(binding = 4) uniform sampler2D normals;
layout(binding = 5) uniform sampler2D mask;
layout(std430, binding = 6) readonly buffer Glints { Glint glints[]; };
layout(binding = 7) uniform writeonly image2D colour;

// Snell's refraction of unit v at unit n (against v); zero at total reflection.
vec3 bend(vec3 v, vec3 n, float eta) {
  float cosine = dot(n, v), k = 1.0 - eta * eta * (1.0 - cosine * cosine);
  return k < 0.0 ? vec3(0.0) : eta * v - (eta * cosine + sqrt(max(k, 0.0))) * n;
}
float fresnel(float cos_i) {
  float eta = u.water_ior, cos_t = sqrt(max(1.0 - (1.0 - cos_i * cos_i) * (1.0 / (eta * eta)), 0.0));
  float parallel = (eta * cos_i - cos_t) / max(eta * cos_i + cos_t, 1e-20);
  float perpendicular = (cos_i - eta * cos_t) / max(cos_i + eta * cos_t, 1e-20);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  GlassPoint g = glass_point(pixel);
  vec4 water = textureLod(normals, g.uv, 0.0);
  vec3 n = vec3(water.xy, max(water.z, 0.05));
  float m = clamp(textureLod(mask, g.uv, 0.0).x, 0.0, 1.0), wet = 1.0 - m;
  float visibility = shown(textureLod(heights, g.uv, 0.0).x);

  vec3 ray = normalize(vec3(g.place, 1.0)), surface = to_camera(n);
  vec3 inside = bend(ray, -u.outward, 1.0 / u.water_ior);
  vec3 bent = bend(inside, -surface, u.water_ior);
  float reflected = fresnel(clamp(dot(bent, surface), 0.0, 1.0));

  float depth = max(textureLod(scene_depth, scene_at(g.place), 0.0).x - g.distance, 0.0);
  float ahead = max(bent.z, 0.05);
  vec2 place = mix(bent.xy / ahead, g.place, g.distance / max(g.distance + depth, 1e-3));
  vec2 at = scene_at(place);

  vec3 sharp = textureLod(pyramid, at, 0.0).rgb, blur = textureLod(pyramid, at, u.blur_lod).rgb;
  vec3 light = mix(sharp, blur, u.wetness * wet * (1.0 - visibility));
  light = mix(light, u.inner * blur, reflected);
  float film = visibility * (1.0 - m * m);
  for (int k = 0; k < u.glint_count; ++k)
    light += highlight(-surface, glints[k].direction, -ray) * (u.glint_strength * film) * glints[k].radiance;
  imageStore(colour, pixel, vec4(mix(u.cabin, light, g.on_glass), 1.0));
}
