// windshield.persist, as-published. This frame's drops over what is left of the height texture of the frame before.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
layout(std140, binding = 0) uniform PersistUniforms {
  float keep;       //   0  [1] Share of the height that a frame leaves.
  float padding_0;  //   4  padding
  float padding_1;  //   8  padding
  float padding_2;  //  12  padding
} u;
layout(binding = 1) uniform sampler2D heights;
layout(binding = 2) uniform sampler2D previous_heights;
layout(binding = 3) uniform writeonly image2D next_heights;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(next_heights))) return;
  float drawn = texelFetch(heights, texel, 0).x, left = texelFetch(previous_heights, texel, 0).x * u.keep;
  imageStore(next_heights, texel, vec4(max(drawn, left), 0.0, 0.0, 0.0));
}
