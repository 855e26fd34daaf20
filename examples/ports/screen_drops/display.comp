// screen_drops.display, as-published and corrected. Display code.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform DisplayUniforms {
  float exposure;   //   0  [1] Factor of the radiance.
  float padding_0;  //   4  padding
  float padding_1;  //   8  padding
  float padding_2;  //  12  padding
} u;
layout(binding = 1) uniform sampler2D colour;
layout(binding = 2) uniform writeonly image2D picture;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(picture))) return;
  vec3 linear = clamp(u.exposure * texelFetch(colour, pixel, 0).rgb, 0.0, 1.0);
  vec3 code = mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
  imageStore(picture, pixel, vec4(code, 1.0));
}
