// windshield.interior, corrected. Pillar and dashboard before the glass, over what is seen through it.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
layout(std140, binding = 0) uniform InteriorUniforms {
  float light;      //   0  [1] Radiance of what is 1 in the interior's picture.
  float padding_0;  //   4  padding
  float padding_1;  //   8  padding
  float padding_2;  //  12  padding
} u;
layout(binding = 1) uniform sampler2D interior;
layout(binding = 2) uniform sampler2D colour;
layout(binding = 3) uniform writeonly image2D seen;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(seen))) return;
  vec4 inside = texelFetch(interior, pixel, 0);
  imageStore(seen, pixel, vec4(u.light * inside.rgb + (1.0 - inside.a) * texelFetch(colour, pixel, 0).rgb, 1.0));
}
