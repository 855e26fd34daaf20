// screen_drops.drops, as-published. The scene through the drops on the window: linear radiance, and where water is.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform PublishedDropsUniforms {
  vec2 resolution;       //   0  [pixel] Columns and rows of the picture.
  float time;            //   8  [s] Frame number over frame rate, rounded once.
  float grid;            //  12  [cell/pixel] Cells of layer 1 in a pixel.
  float keep;            //  16  [1] Times 5 - layer: the noise below which a cell holds a drop.
  float refraction;      //  20  [1] Pictures per unit of the normal.
  int printed_misprint;  //  24  [1] 1: the displacement as the report prints it.
  float padding_0;       //  28  padding
} u;
layout(binding = 1) uniform sampler2D background;
layout(binding = 2) uniform sampler2D scene;
layout(binding = 3) uniform sampler2D noise;
layout(binding = 4) uniform writeonly image2D water;
layout(binding = 5) uniform writeonly image2D colour;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec2 at = (vec2(pixel) + 0.5) / u.resolution;
  vec2 n = textureLod(noise, at * 0.1, 0.0).rg;
  vec2 shift = u.printed_misprint != 0 ? vec2((1.0 - 0.5) * 2.0) : (n - 0.5) * 2.0;
  float layer = 0.0;
  vec3 light = texelFetch(background, pixel, 0).rgb;
  for (int k = 4; k > 0; --k) {
    float r = float(k);
    vec2 x = u.resolution * r * u.grid, p = 6.28 * at * x + shift, s = sin(p);
    vec3 d = textureLod(noise, floor(at * x - 0.25 + 0.5) / x, 0.0).rgb;
    float t = (s.x + s.y) * max(0.0, 1.0 - fract(u.time * (d.b + 0.1) + d.g) * 2.0);
    if (!(d.r < (5.0 - r) * u.keep && t > 0.5)) continue;
    float z = mix(0.2, 2.0, t - 0.5);
    vec3 v = -normalize(vec3(cos(p), z));
    layer = r;
    light = textureLod(scene, at - v.xy * u.refraction, 0.0).rgb;
  }
  imageStore(water, pixel, vec4(layer * 0.25));
  imageStore(colour, pixel, vec4(light, 1.0));
}
