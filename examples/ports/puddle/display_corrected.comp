// puddle.display, corrected. Vignette and display code.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "display.glsl"

vec3 encode_srgb(vec3 linear) {
  vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
  return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(picture))) return;
  vec3 radiance = texelFetch(colour, pixel, 0).rgb;
  float light = max(vignette(pixel), 0.0) * u.exposure;
  vec3 linear = light * radiance;
  vec3 code = encode_srgb(clamp(linear, 0.0, 1.0));
  imageStore(picture, pixel, vec4(code, 1.0));
}
