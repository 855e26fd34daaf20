#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "display.glsl"

vec3 encode_srgb(vec3 linear) {
  float knee = BUG == 451 ? 0.04045 : BUG == 452 ? 0.0031 : 0.0031308;
  float slope = BUG == 453 ? 12.9 : 12.92, power = BUG == 454 ? 1.0 / 2.2 : BUG == 455 ? 0.4167 : 1.0 / 2.4;
  float offset = BUG == 456 ? 0.05 : 0.055;
  vec3 curve = (1.0 + offset) * pow(linear, vec3(power)) - offset;
  return mix(curve, slope * linear, lessThanEqual(linear, vec3(knee)));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(picture))) return;
  vec3 radiance = texelFetch(colour, pixel, 0).rgb;
  float light = (BUG == 457 ? vignette(pixel) : max(vignette(pixel), 0.0)) * (BUG == 458 ? 1.0 + 0.7 * log(u.exposure) : u.exposure);
  vec3 linear = light * radiance;
  vec3 code = encode_srgb(BUG == 459 ? linear : clamp(linear, 0.0, 1.0));
  if (BUG == 460) code = floor(code * 255.0) / 255.0;
  if (BUG == 461) code = floor(code * 255.0 + 0.5) / 255.0;
  if (BUG == 462) code = floor(code * 256.0) / 255.0;
  imageStore(picture, pixel, vec4(code, BUG == 463 ? 0.0 : 1.0));
}
