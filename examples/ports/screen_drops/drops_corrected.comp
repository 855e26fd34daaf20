// screen_drops.drops, corrected. The scene through the drops on the window: linear radiance, and where water is.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform DropsUniforms {
  vec4 cells_per_pixel;  //   0  [cell/pixel] Of each layer.
  vec4 offset_x;         //  16  [cell] Place of the picture's corner in each layer.
  vec4 offset_y;         //  32  [cell] Place of the picture's corner in each layer.
  vec4 pixels_per_cell;  //  48  [pixel/cell] Of each layer.
  vec4 level;            //  64  [1] Mip level at which each layer's drops see the scene.
  ivec4 first_row;       //  80  [texel] Row of cells where each layer begins.
  vec2 pixel;            //  96  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;        // 104  [1] Half the extent of the image plane at distance 1.
  vec2 scene_scale;      // 112  [1] Texture coordinates of the scene per unit of the image plane.
  float sine;            // 120  [1] Of the contact angle.
  float water_ior;       // 124  [1] Refractive index of water.
  float inner;           // 128  [1] Share of the background that the water's surface mirrors.
  int has_flow;          // 132  [1] 1: height counts.
  vec2 flow_slope;       // 136  [1/mm] Slope per difference of heights two texels apart.
  vec2 flow_pixel;       // 144  [1] 1 over the picture's columns and rows.
  float visible_from;    // 152  [mm] Height at which flowing water begins to show.
  float visible_to;      // 156  [mm] Height from which it shows fully.
  float flow_level;      // 160  [1] Mip level at which flowing water sees the scene.
  float padding_0;       // 164  padding
  vec2 flow_texel;       // 168  [1] 1 over the columns and rows of height.
} u;
layout(binding = 1) uniform sampler2D background;
layout(binding = 2) uniform sampler2D scene;
layout(binding = 3) uniform sampler2D cells;
layout(binding = 4) uniform sampler2D height;
layout(binding = 5) uniform writeonly image2D water;
layout(binding = 6) uniform writeonly image2D colour;

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
// Normal's x, y; coverage; mip level.
vec4 still_drops(vec2 at) {
  vec4 s = vec4(0.0);
  for (int l = 3; l >= 0; --l) {
    vec2 q = at * u.cells_per_pixel[l] + vec2(u.offset_x[l], u.offset_y[l]);
    ivec2 texel = clamp(ivec2(floor(q)) + ivec2(0, u.first_row[l]), ivec2(0), textureSize(cells, 0) - 1);
    vec4 drop = texelFetch(cells, texel, 0);
    vec2 d = fract(q) - drop.xy;
    float radius = drop.z, pixels = u.pixels_per_cell[l];
    float cover = clamp((radius - length(d)) * pixels + 0.5, 0.0, 1.0) * min(2.0 * radius * pixels, 1.0);
    s = mix(s, vec4(d * u.sine / max(radius, 1e-3), 1.0, u.level[l]), cover);
  }
  return s;
}
vec4 with_flow(vec4 s, vec2 at) {
  vec2 place = at * u.flow_pixel;
  vec2 dx = vec2(u.flow_texel.x, 0.0), dy = vec2(0.0, u.flow_texel.y);
  float left = textureLod(height, place - dx, 0.0).x, right = textureLod(height, place + dx, 0.0).x;
  float down = textureLod(height, place - dy, 0.0).x, up = textureLod(height, place + dy, 0.0).x;
  float t = clamp((0.25 * (left + right + down + up) - u.visible_from) / (u.visible_to - u.visible_from), 0.0, 1.0);
  float cover = t * t * (3.0 - 2.0 * t);
  vec2 slope = vec2(right - left, up - down) * u.flow_slope;
  float inverse = inversesqrt(1.0 + dot(slope, slope));
  return mix(s, vec4(-slope * inverse, 1.0, u.flow_level), cover);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(colour))) return;
  vec2 at = vec2(pixel) + 0.5;
  vec3 behind = texelFetch(background, pixel, 0).rgb;
  vec4 s = still_drops(at);
  if (u.has_flow != 0) s = with_flow(s, at);
  imageStore(water, pixel, vec4(s.z));
  imageStore(colour, pixel, vec4(behind, 1.0));
  if (s.z <= 0.0) return;
  vec3 ray = normalize(vec3(at * u.pixel - u.half_size, 1.0));
  vec3 normal = normalize(vec3(s.xy, sqrt(max(1.0 - s.x * s.x - s.y * s.y, 0.04))));
  vec3 bent = bend(bend(ray, vec3(0.0, 0.0, -1.0), 1.0 / u.water_ior), -normal, u.water_ior);
  float reflected = fresnel(clamp(dot(bent, normal), 0.0, 1.0));
  vec2 seen = 0.5 + bent.xy / max(bent.z, 0.05) * u.scene_scale;
  vec3 light = mix(textureLod(scene, seen, s.w).rgb, u.inner * behind, reflected);
  imageStore(colour, pixel, vec4(mix(behind, light, s.z), 1.0));
}
