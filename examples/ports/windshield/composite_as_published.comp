// windshield.composite, as-published. The scene through film and drops, with glints: linear radiance.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "composite.glsl"
layout(binding = 1) uniform sampler2D pyramid;
layout(binding = 2) uniform sampler2D heights;
layout(binding = 3) uniform sampler2D normals;
layout(binding = 4) uniform sampler2D mask;
layout(std430, binding = 5) readonly buffer Glints { Glint glints[]; };
layout(binding = 6) uniform writeonly image2D colour;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  GlassPoint g = glass_point(pixel);
  vec4 water = textureLod(normals, g.uv, 0.0);
  vec3 n = vec3(water.xy, max(water.z, 0.05));
  float wet = 1.0 - clamp(textureLod(mask, g.uv, 0.0).x, 0.0, 1.0);
  float visibility = shown(textureLod(heights, g.uv, 0.0).x) * wet;
  vec2 screen = scene_at(g.place), offset = u.refraction * visibility * n.xy;
  vec3 behind = textureLod(pyramid, screen, 0.0).rgb, blur = textureLod(pyramid, screen, u.blur_lod).rgb;
  vec3 sharp = textureLod(pyramid, screen + offset, 0.0).rgb;
  vec3 light = mix(mix(behind, blur, u.wetness * wet), sharp, visibility);
  vec3 to_eye = -(1.0 / length(vec3(g.place, 1.0))) * vec3(g.place, 1.0);
  vec3 facing = -to_camera(n);
  for (int k = 0; k < u.glint_count; ++k)
    light += highlight(facing, glints[k].direction, to_eye) * (u.glint_strength * visibility) * glints[k].radiance;
  imageStore(colour, pixel, vec4(mix(u.cabin, light, g.on_glass), 1.0));
}
