#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "display.glsl"

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(picture))) return;
  vec3 radiance = texelFetch(colour, pixel, 0).rgb;
  float light = vignette(pixel);
  vec3 code = pow(light * radiance, vec3(BUG == 411 ? 1.0 / 2.2 : BUG == 412 ? 0.45 : 0.4545));
  if (BUG == 413) code = light * pow(radiance, vec3(0.4545));
  if (BUG == 414) {
    vec3 linear = light * radiance;
    code = mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
  }
  if (BUG == 415) code = code.bgr;
  imageStore(picture, pixel, vec4(code, 1.0));
}
