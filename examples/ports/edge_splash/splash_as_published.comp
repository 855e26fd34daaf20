// edge_splash.splash, as-published. Masks of edge, angle and noise, and the scene with drops blended over it.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform PublishedSplashUniforms {
  vec4 drop_color;        //   0  [1] Linear RGB and opacity of the drops.
  int width;              //  16  [texel] Columns of the picture.
  int height;             //  20  [texel] Rows of the picture.
  int noise_width;        //  24  [texel] Columns of the noise map.
  int noise_height;       //  28  [texel] Rows of the noise map.
  float edge_threshold;   //  32  [1] Sobel sum of device depths that counts as an edge.
  float rain_drop_scale;  //  36  [1] Threshold of the noise.
  float time;             //  40  [s] Frame number over frame rate, rounded once.
  float drop_speed;       //  44  [texel/s] Speed of the noise in x and in y.
  int thickness;          //  48  [texel] Distance of the taps where the depth is 1.
  float padding_0;        //  52  padding
  float padding_1;        //  56  padding
  float padding_2;        //  60  padding
} u;
layout(binding = 1) uniform sampler2D scene;
layout(binding = 2) uniform sampler2D depth;
layout(binding = 3) uniform sampler2D noise_map;
layout(binding = 4) uniform writeonly image2D edge_image;
layout(binding = 5) uniform writeonly image2D angle_image;
layout(binding = 6) uniform writeonly image2D noise_image;
layout(binding = 7) uniform writeonly image2D colour;

// A load outside a texture is undefined here and 0 in HLSL.
float load(sampler2D image, ivec2 at) {
  ivec2 size = textureSize(image, 0);
  bool inside = all(greaterThanEqual(at, ivec2(0))) && !outside(at, size);
  return inside ? texelFetch(image, at, 0).r : 0.0;
}
// C's fmod: GLSL's mod takes the sign of the divisor.
int remainder_of(float x, float size) {
  float rest = x - size * trunc(x / size);
  if (x >= 0.0 && rest < 0.0) rest += size;
  if (x < 0.0 && rest > 0.0) rest -= size;
  return int(rest);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(colour);
  if (outside(pixel, size)) return;
  vec4 below = texelFetch(scene, pixel, 0);
  if (any(greaterThanEqual(pixel + u.thickness, ivec2(u.width, u.height))) || any(lessThan(pixel - u.thickness, ivec2(0)))) {
    imageStore(edge_image, pixel, vec4(0.0));
    imageStore(angle_image, pixel, vec4(0.0));
    imageStore(noise_image, pixel, vec4(0.0));
    imageStore(colour, pixel, clamp(below, 0.0, 1.0));
    return;
  }

  float d = load(depth, pixel);
  float shift = float(u.thickness) * (d * d);
  int x = pixel.x;
  int y = int(float(pixel.y) - shift);
  int left = int(float(x) - shift), right = int(float(x) + shift);
  int low = int(float(y) - shift), high = int(float(y) + shift);
  float p0 = load(depth, ivec2(left, high)), p1 = load(depth, ivec2(x, y - u.thickness)), p2 = load(depth, ivec2(right, low));
  float p3 = load(depth, ivec2(left, y)), p5 = load(depth, ivec2(right, y));
  float p6 = load(depth, ivec2(left, high)), p7 = load(depth, ivec2(x, high)), p8 = load(depth, ivec2(right, high));
  float gx = -p0 - 2.0 * p3 - p6 + p2 + 2.0 * p5 + p8;
  float gy = -p0 - 2.0 * p1 - p2 + p6 + 2.0 * p7 + p8;

  const float pi = 3.14159265;
  float strength = sqrt(gx * gx + gy * gy);
  float edge = step(u.edge_threshold, strength);
  float angle = step((atan(gy, gx) + pi) / (2.0 * pi), 0.5);
  float scrolled = u.time * u.drop_speed;
  ivec2 place = ivec2(remainder_of(float(x) + scrolled, float(u.noise_width)),
                      remainder_of(float(pixel.y) + scrolled, float(u.noise_height)));
  float noise = step(u.rain_drop_scale, load(noise_map, place));

  float mask = edge * angle * noise;
  vec4 result = mix(below, u.drop_color, mask * u.drop_color.a);
  imageStore(edge_image, pixel, vec4(edge));
  imageStore(angle_image, pixel, vec4(angle));
  imageStore(noise_image, pixel, vec4(noise));
  imageStore(colour, pixel, clamp(result, 0.0, 1.0));
}
