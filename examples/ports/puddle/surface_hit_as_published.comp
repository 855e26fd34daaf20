// puddle.surface_hit, as-published. Where each pixel's view ray meets the water, and the normal there.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "surface_hit.glsl"
#include "camera.glsl"

layout(binding = 2) uniform writeonly image2D hit_image;
layout(binding = 3) uniform writeonly image2D normal_image;

// The article reads the level before the newest, still encoded.
float level(vec2 place) {
  vec2 stored = WAVE(place, ivec2(0));
  return stored.y;
}
vec2 water_place(vec3 p) { return 0.5 * (p.xz / u.half_size.xz + 1.0); }

// Distance from a box whose top the water displaces; 0 inside.
float scene(vec3 p) {
  float d = level(water_place(p));
  return length(max(abs(p + vec3(0.0, d, 0.0)) - u.half_size, 0.0));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(hit_image))) return;
  vec3 ray = view_ray(pixel), p = u.camera_position;
  float steps = 0.0;
  bool hit = false;
  for (int i = 0; i < u.max_steps; ++i) {
    float d = scene(p);
    steps = float(i);
    hit = d < u.epsilon;
    // Away from a convex box for good.
    if (hit || d >= 1000.0) break;
    p += d * ray;
  }
  if (!hit) {
    p = u.camera_position;
    steps = float(u.max_steps - 1);
  }

  vec2 place = water_place(p), texel = u.texel;
  float left = level(place - vec2(texel.x, 0.0)), right = level(place + vec2(texel.x, 0.0));
  float down = level(place - vec2(0.0, texel.y)), up = level(place + vec2(0.0, texel.y));
  vec3 normal = normalize(vec3((left - right) * u.normal_gain, 1.0, (down - up) * u.normal_gain));
  imageStore(hit_image, pixel, vec4(p, steps));
  imageStore(normal_image, pixel, vec4(normal, hit ? 1.0 : 0.0));
}
