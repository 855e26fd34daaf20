// rainy_glass.rain_on_glass, as-published. The scene seen through the wet glass: linear radiance.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "rain_on_glass.glsl"
layout(binding = 7) uniform writeonly image2D colour;

// A place on a map that is turned by this cosine and sine.
vec2 turned(vec2 place, vec2 turn) { return vec2(place.x * turn.x - place.y * turn.y, place.x * turn.y + place.y * turn.x); }

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec4 normal = texelFetch(orientation, pixel, 0);
  if (normal.w <= 0.5) {
    imageStore(colour, pixel, vec4(texelFetch(scene, pixel, 0).rgb, 1.0));
    return;
  }
  vec2 place = texelFetch(surface, pixel, 0).xy;
  vec4 drop = textureLod(raindrops, turned(place, u.turn) * u.drop_tiles, 0.0);
  if (u.signed_offset != 0) drop.z = 2.0 * drop.z - 1.0;
  float timer = fract(u.time * u.drop_rate + drop.z);
  float eroded = drop.w - (1.0 - u.rain_amount) - timer, mask = eroded > 0.0 ? 1.0 : 0.0;

  vec2 base = turned(place, u.rivulet_turn) * u.rivulet_tiles + vec2(0.0, u.scroll);
  vec2 flow = textureLod(rivulets, base, 0.0).zw;
  flow = u.flow_from + u.flow_span * flow;
  vec3 phase = flow_phases(u.time * u.flow_rate);
  if (u.squared_weight != 0) phase.z *= phase.z;
  vec2 first = textureLod(rivulets, base + u.flow_strength * phase.x * flow, 0.0).xy;
  vec2 second = textureLod(rivulets, base + u.flow_strength * phase.y * flow, 0.0).xy;
  vec2 streak = mix(first, second, phase.z);
  float upright = 1.0 - abs(normal.y);
  upright = u.rivulet_amount * min(upright * u.fade_rate, 1.0);
  vec2 sum = mask * drop.xy + upright * streak;
  vec2 offset = u.distortion * (2.0 * sum - 1.0);
  if (u.remap_first != 0) offset = u.distortion * (mask * (2.0 * drop.xy - 1.0) + upright * (2.0 * streak - 1.0));
  vec2 screen = (vec2(pixel) + 0.5) * u.pixel + offset;
  vec3 behind = u.use_probe != 0 ? probe_at((2.0 * screen - 1.0) * vec2(u.half_width, u.half_height)) : textureLod(scene, screen, 0.0).rgb;
  imageStore(colour, pixel, vec4(u.tint * behind, 1.0));
}
