// puddle.shade, as-published. Reflection, refraction, water and ground: linear radiance.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(binding = 1) uniform sampler2D hit_image;
layout(binding = 2) uniform sampler2D normal_image;
layout(binding = 3) uniform sampler2D noise;
layout(binding = 4) uniform sampler2D environment;
layout(binding = 5) uniform sampler2D ground;
layout(binding = 6) uniform writeonly image2D colour;
#include "shade.glsl"
#include "camera.glsl"

vec3 decode(vec3 code) {
  return pow(code, vec3(2.2));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec3 p = texelFetch(hit_image, pixel, 0).xyz, view = view_ray(pixel);
  vec4 surface = texelFetch(normal_image, pixel, 0);
  vec3 normal = surface.xyz;
  bool hit = surface.w > 0.5;
  vec3 reflected = decode(sample_environment(hit ? reflect(view, normal) : view, 0.0));
  if (!hit) {
    imageStore(colour, pixel, vec4(reflected, 1.0));
    return;
  }

  float cosine = min(abs(dot(view, normal)), 1.0);
  float fresnel = schlick(cosine);
  vec3 bent = refract(view, normal, 1.0 / WATER_IOR);
  float t = abs(bent.y) < 0.0001 ? -1.0 : (-u.puddle_depth - p.y) / bent.y;
  bool on_ground = t > 0.0;
  vec3 below = 0.3 * u.tint;
  if (on_ground) {
    vec2 place = p.xz + t * bent.xz;
    vec3 base;
    if (u.use_checkerboard != 0) {
      base = checkerboard(place) + (texelFetch(noise, pixel, 0).x - 0.5) * 0.05;
    } else {
      base = 0.6 * decode(textureLod(ground, place * u.ground_scale, 0.0).rgb);
    }
    below = 0.7 * (1.0 - 0.5 * u.tint) * mix(u.tint, base, transmittance(u.water_turbidity, t));
  }

  float weight = fresnel * (mix(0.3, 0.8, u.reflectivity) - 0.3) + 0.3;
  vec3 light = mix(below, reflected, weight) + 0.15 * (1.0 - fresnel) * u.tint;
  float fog = transmittance(u.fog_depth, distance(p, u.camera_position));
  imageStore(colour, pixel, vec4(mix(0.7 * light, light, fog), 1.0));
}
