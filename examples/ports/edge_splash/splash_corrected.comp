// edge_splash.splash, corrected. Masks of edge, angle and noise, and the scene with drops blended over it.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform SplashUniforms {
  vec4 drop_color;    //   0  [1] Linear RGB and opacity of the drops.
  vec3 up;            //  16  [1] Unit vector that points up, camera axes: right, up, forward.
  float reach;        //  28  [texel] Texels that the band covers at 1 m.
  vec2 pixel;         //  32  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;     //  40  [1] Half the extent of the image plane at distance 1.
  float depth_scale;  //  48  [1/m] 1 / z = depth_scale d + depth_bias.
  float depth_bias;   //  52  [1/m] See depth_scale.
  float reach_min;    //  56  [texel] Smallest reach of the taps.
  float reach_max;    //  60  [texel] Largest reach of the taps; whole.
  float step_low;     //  64  [m] Sobel sum of distances at which an edge begins.
  float step_high;    //  68  [m] Sobel sum from which it is whole.
  float bend_low;     //  72  [1] Bend at which an edge begins.
  float bend_high;    //  76  [1] Bend from which it is whole.
  float cosine_low;   //  80  [1] Cosine between an edge's normal and up at which the mask begins.
  float cosine_high;  //  84  [1] Cosine from which it is whole.
  float noise_low;    //  88  [1] Noise at which a drop begins.
  float noise_high;   //  92  [1] Noise from which it is whole.
  vec2 noise_scale;   //  96  [1] Texture coordinates of the noise in a pixel.
  vec2 noise_offset;  // 104  [1] Texture coordinates that the noise has scrolled, in [0, 1).
} u;
layout(binding = 1) uniform sampler2D scene;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D noise_map;
layout(binding = 4) uniform sampler2D layer;
layout(binding = 5) uniform writeonly image2D edge_image;
layout(binding = 6) uniform writeonly image2D angle_image;
layout(binding = 7) uniform writeonly image2D noise_image;
layout(binding = 8) uniform writeonly image2D colour;

float inverse_distance(ivec2 at) {
  ivec2 last = textureSize(depth, 0) - 1;
  float d = texelFetch(depth, clamp(at, ivec2(0), last), 0).r;
  return d * u.depth_scale + u.depth_bias;
}
float ramp(float low, float high, float x) {
  float t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(colour);
  if (outside(pixel, size)) return;
  int widest = int(u.reach_max);
  float q = inverse_distance(pixel);
  float nearest = max(max(inverse_distance(pixel - ivec2(widest, 0)), inverse_distance(pixel + ivec2(widest, 0))),
                      max(inverse_distance(pixel - ivec2(0, widest)), inverse_distance(pixel + ivec2(0, widest))));
  nearest = max(q, nearest);
  float wanted = u.reach * nearest;
  int r = int(floor(clamp(wanted, u.reach_min, u.reach_max) + 0.5));

  float z[9], near[9];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      near[3 * j + i] = inverse_distance(pixel + r * ivec2(i - 1, j - 1));
      z[3 * j + i] = 1.0 / near[3 * j + i];
    }
  }
  vec2 g = vec2(z[2] - z[0] + 2.0 * (z[5] - z[3]) + z[8] - z[6], z[6] - z[0] + 2.0 * (z[7] - z[1]) + z[8] - z[2]);
  float bend = max(abs(near[3] + near[5] - 2.0 * near[4]), abs(near[1] + near[7] - 2.0 * near[4])) /
               max(max(near[4], max(near[3], near[5])), max(near[1], near[7]));
  float edge = ramp(u.step_low, u.step_high, length(g));
  edge *= ramp(u.bend_low, u.bend_high, bend);

  vec2 place = (vec2(pixel) + 0.5) * u.pixel - u.half_size;
  vec2 up = u.up.xy - place * u.up.z;
  float facing = dot(g, up) / max(length(g), u.step_low) / max(length(up), 1e-4);
  float angle = ramp(u.cosine_low, u.cosine_high, facing);

  vec2 at = (vec2(pixel) + 0.5) * u.noise_scale + u.noise_offset;
  float noise = ramp(u.noise_low, u.noise_high, textureLod(noise_map, at, 0.0).r);

  vec4 below = texelFetch(scene, pixel, 0);
  float weight = edge * angle * noise * texelFetch(layer, pixel, 0).r * u.drop_color.a;
  vec3 result = mix(below.rgb, u.drop_color.rgb, weight);
  imageStore(edge_image, pixel, vec4(edge));
  imageStore(angle_image, pixel, vec4(angle));
  imageStore(noise_image, pixel, vec4(noise));
  imageStore(colour, pixel, vec4(result, below.a));
}
