// rainy_glass.rain_on_glass, corrected. The scene seen through the wet glass: linear radiance.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "rain_on_glass.glsl"
layout(binding = 7) uniform sampler2D scene_depth;
layout(binding = 8) uniform sampler2D near_depth;
layout(binding = 9) uniform writeonly image2D colour;

vec2 slope_of(vec2 stored, float neutral, float scale) {
  vec2 n = (stored - neutral) * scale;
  return -n / sqrt(max(1.0 - n.x * n.x - n.y * n.y, 0.04));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec3 own = texelFetch(scene, pixel, 0).rgb;
  imageStore(colour, pixel, vec4(own, 1.0));
  vec4 normal = texelFetch(orientation, pixel, 0);
  vec3 glass = texelFetch(surface, pixel, 0).xyz;
  float depth = texelFetch(scene_depth, pixel, 0).x;
  if (normal.w <= 0.5 || depth <= glass.z) return;

  float amount = u.rain_amount * clamp(dot(normal.xyz, u.rain_to), 0.0, 1.0);
  vec4 drop = textureLod(raindrops, glass.xy * u.drop_tiles, 0.0);
  float timer = fract(u.drop_phase + drop.z);
  float threshold = max(1.0 - timer / u.impact, (timer - u.impact) / (1.0 - u.impact));
  float excess = drop.w - (1.0 - amount) - threshold, shown = clamp(excess * u.sharpness, 0.0, 1.0);

  vec2 base = glass.xy * u.rivulet_tiles;
  vec2 flow = (textureLod(rivulets, base, 0.0).zw - u.rivulet_neutral) * u.rivulet_scale * vec2(u.flow_strength, u.run_strength);
  vec3 phase = flow_phases(u.flow_phase);
  vec2 scrolled = base + vec2(0.0, u.scroll);
  vec2 first = textureLod(rivulets, scrolled + flow * (phase.x - 0.5), 0.0).xy;
  vec2 second = textureLod(rivulets, scrolled + flow * (phase.y - 0.5), 0.0).xy;
  vec2 streak = slope_of(mix(first, second, phase.z), u.rivulet_neutral, u.rivulet_scale);
  float steep = length(normal.xz);
  vec2 slope = shown * slope_of(drop.xy, u.drop_neutral, u.drop_scale) + u.rivulet_amount * steep * streak;
  if (dot(slope, slope) <= 1e-8) return;

  vec3 along_u = vec3(normal.z, 0.0, -normal.x) / max(length(normal.xz), 0.05), along_v = cross(normal.xyz, along_u);
  vec3 rise = slope.x * along_u + slope.y * along_v;
  vec2 moved = u.bend * vec2(dot(rise, u.right), dot(rise, u.up));
  vec2 screen = (vec2(pixel) + 0.5) * u.pixel;
  if (u.use_probe != 0) {
    imageStore(colour, pixel, vec4(probe_at((2.0 * screen - 1.0) * vec2(u.half_width, u.half_height) + moved), 1.0));
    return;
  }
  float beyond = clamp(1.0 - glass.z / max(depth, 1e-3), 0.0, 1.0);
  screen += moved * beyond * 0.5 / vec2(u.half_width, u.half_height);
  if (textureLod(near_depth, screen, 0.0).x <= glass.z) return;
  imageStore(colour, pixel, vec4(textureLod(scene, screen, 0.0).rgb, 1.0));
}
