// rainy_glass.rain_on_glass as the article's author ships it, from the table in docs/effects/rainy_glass.md alone: the numbers of its eight
// readings stand here, and no uniform of a reading is declared.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform Given {
  vec2 pixel;
  float time;
  float rain_amount;
  float tiles;  // one tiling for both maps
} given;
layout(binding = 1) uniform sampler2D surface;
layout(binding = 2) uniform sampler2D orientation;
layout(binding = 3) uniform sampler2D raindrops;
layout(binding = 4) uniform sampler2D rivulets;
layout(binding = 5) uniform sampler2D scene;
layout(binding = 7) uniform writeonly image2D colour;

const vec3 TINT = vec3(0.88, 0.92, 0.92);

vec2 to_signed(vec2 stored) { return 2.0 * stored - 1.0; }

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec4 facing = texelFetch(orientation, here, 0);
  if (facing.w <= 0.5) {
    imageStore(colour, here, vec4(texelFetch(scene, here, 0).rgb, 1.0));
    return;
  }
  vec2 tile = texelFetch(surface, here, 0).xy * given.tiles;

  vec4 drop = textureLod(raindrops, tile, 0.0);
  float timer = fract(0.3 * given.time + (2.0 * drop.b - 1.0));
  float mask = drop.a - (1.0 - given.rain_amount) - timer > 0.0 ? 1.0 : 0.0;

  vec2 map = tile + vec2(0.0, 0.2 * given.time);
  vec2 flow = textureLod(rivulets, map, 0.0).ba * vec2(0.2, 3.0) - vec2(0.1, 0.0);
  float first = fract(0.23 * given.time), second = fract(0.23 * given.time + 0.5), away = 1.0 - 2.0 * first;
  vec2 streak = mix(textureLod(rivulets, map + first * flow, 0.0).rg, textureLod(rivulets, map + second * flow, 0.0).rg, away * away);

  float whole = clamp((1.0 - abs(facing.y)) / 0.15, 0.0, 1.0);
  vec2 water = mask * to_signed(drop.rg) + whole * to_signed(streak);
  vec2 place = (vec2(here) + 0.5) * given.pixel + 0.01 * water;
  imageStore(colour, here, vec4(TINT * textureLod(scene, place, 0.0).rgb, 1.0));
}
