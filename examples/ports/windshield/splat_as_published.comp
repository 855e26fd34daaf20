// windshield.splat, as-published. The height of the water: every live drop, in slot order.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "splat.glsl"
layout(binding = 2) uniform writeonly image2D heights;

Neck neck_of(uint id) { return Neck(vec2(0.0), 0.0, 0.0, id, 0.0, 0.0, 0.0); }

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(heights))) return;
  imageStore(heights, texel, vec4(blended(texel), 0.0, 0.0, 0.0));
}
