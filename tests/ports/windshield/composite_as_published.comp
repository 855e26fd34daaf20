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
  if (BUG == 1410) wet = 1.0 - wet;
  float visibility = shown(textureLod(heights, g.uv, 0.0).x) * (BUG == 1411 ? 1.0 : wet);
  vec2 screen = scene_at(g.place), offset = u.refraction * visibility * n.xy;
  if (BUG == 1412) offset = -offset;
  if (BUG == 1413) offset = u.refraction * n.xy;
  if (BUG == 1414) offset.x *= u.half_size.y / u.half_size.x;
  vec3 behind = textureLod(pyramid, screen, 0.0).rgb, blur = textureLod(pyramid, screen, BUG == 1415 ? floor(u.blur_lod) + 1.0 : u.blur_lod).rgb;
  vec3 sharp = textureLod(pyramid, screen + offset, BUG == 1416 ? 1.0 : 0.0).rgb;
  vec3 light = mix(mix(behind, blur, u.wetness * (BUG == 1417 ? 1.0 : wet)), sharp, visibility);
  vec3 to_eye = -(1.0 / length(vec3(g.place, 1.0))) * vec3(g.place, 1.0);
  vec3 facing = -to_camera(n);
  for (int k = BUG == 1418 ? 1 : 0; k < u.glint_count; ++k)
    light += highlight(facing, glints[k].direction, BUG == 1419 ? vec3(0.0, 0.0, -1.0) : to_eye) * (u.glint_strength * (BUG == 1420 ? 1.0 : visibility)) * glints[k].radiance;
  imageStore(colour, pixel, vec4(mix(u.cabin, light, g.on_glass), 1.0));
}
