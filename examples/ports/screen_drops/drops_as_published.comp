// screen_drops.drops, as-published. The scene through the drops on the window: linear radiance, and where water is.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform PublishedDropsUniforms {
  vec2 resolution;       //   0  [pixel] Columns and rows of the picture.
  float time;            //   8  [s] Frame number over frame rate, rounded once.
  float grid;            //  12  [cell/pixel] Cells of layer 1 in a pixel.
  float keep;            //  16  [1] Times keep_from - layer: the noise below which a cell holds a drop.
  float refraction;      //  20  [1] Pictures per unit of the normal.
  int printed_misprint;  //  24  [1] 1: the displacement as the report prints it.
  int noise_nearest;     //  28  [1] 1: noise is looked up unfiltered, texel floor(fract(u) size).
  int layers;            //  32  [1] Grids of cells.
  float water_step;      //  36  [1] 1 over layers.
  float cell_angle;      //  40  [rad] Of the sine over a cell.
  float noise_middle;    //  44  [1] Noise that displaces nothing.
  float displacement;    //  48  [rad] Of the grid per unit of noise.
  float keep_from;       //  52  [1] Layer from which on no cell holds a drop.
  float threshold;       //  56  [1] Sum of the sines above which a drop is.
  int printed_normal;    //  60  [1] 1: the normal as the report prints it, of the cosine of a sine.
  float level;           //  64  [1] Mip level at which drops see the scene, without gradient_level.
  int gradient_level;    //  68  [1] 1: the level follows from the gradient of the drop's normal.
  float padding_0;       //  72  padding
  float padding_1;       //  76  padding
} u;
layout(binding = 1) uniform sampler2D background;
layout(binding = 2) uniform sampler2D scene;
layout(binding = 3) uniform sampler2D noise;
layout(binding = 4) uniform writeonly image2D water;
layout(binding = 5) uniform writeonly image2D colour;

vec4 noise_at(vec2 at) {
  if (u.noise_nearest == 0) return textureLod(noise, at, 0.0);
  ivec2 size = textureSize(noise, 0);
  return texelFetch(noise, ivec2(floor(fract(at) * vec2(size))) % size, 0);
}

// How far, squared, the lookup goes in the scene [texel] in a step of one pixel. w: the drop's normal, not normalized; turn: w's derivative.
float squared_stride(vec3 w, vec3 turn, vec2 one_pixel) {
  float inverse = 1.0 / length(w);
  vec3 v = w * inverse, turned = (turn - v * dot(v, turn)) * inverse;
  vec2 way = one_pixel + u.resolution * u.refraction * turned.xy;
  return dot(way, way);
}
// p: the drop's angles; fade: its share of the full size; layer: number of its grid.
float level_of(vec3 w, vec2 p, float fade, float layer) {
  if (u.gradient_level == 0) return u.level;
  vec2 turn = u.printed_normal != 0 ? sin(sin(p)) * cos(p) : sin(p), rise = 1.8 * fade * cos(p);
  float per_pixel = u.cell_angle * (layer * u.grid);
  float across = squared_stride(w, vec3(-turn.x, 0.0, rise.x) * per_pixel, vec2(1.0, 0.0));
  float upward = squared_stride(w, vec3(0.0, -turn.y, rise.y) * per_pixel, vec2(0.0, 1.0));
  return log(max(max(across, upward), 1.0)) * 0.7213475;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec2 at = (vec2(pixel) + 0.5) / u.resolution;
  vec2 n = noise_at(at * 0.1).rg;
  vec2 shift = u.printed_misprint != 0 ? vec2((1.0 - u.noise_middle) * u.displacement) : (n - u.noise_middle) * u.displacement;
  float layer = 0.0;
  vec3 light = texelFetch(background, pixel, 0).rgb;
  for (int k = u.layers; k > 0; --k) {
    float r = float(k);
    vec2 x = u.resolution * r * u.grid, p = u.cell_angle * at * x + shift, s = sin(p);
    vec3 d = noise_at(floor(at * x - 0.25 + 0.5) / x).rgb;
    float t = (s.x + s.y) * max(0.0, 1.0 - fract(u.time * (d.b + 0.1) + d.g) * 2.0);
    if (!(d.r < (u.keep_from - r) * u.keep && t > u.threshold)) continue;
    float z = mix(0.2, 2.0, t - 0.5);
    vec3 w = vec3(cos(u.printed_normal != 0 ? s : p), z), v = -normalize(w);
    float age = fract(d.g + u.time * (d.b + 0.1));
    layer = r;
    light = textureLod(scene, at - v.xy * u.refraction, level_of(w, p, max(1.0 - age * 2.0, 0.0), r)).rgb;
  }
  imageStore(water, pixel, vec4(layer * u.water_step));
  imageStore(colour, pixel, vec4(light, 1.0));
}
