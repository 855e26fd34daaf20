// windshield.join_panes, as-published and corrected. The picture so far, and on a further pane what the eye sees through it.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "composite.glsl"
layout(binding = 1) uniform sampler2D pane_colour;
layout(binding = 2) uniform sampler2D colour;
layout(binding = 3) uniform writeonly image2D joined;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(joined))) return;
  vec3 before = texelFetch(colour, pixel, 0).rgb, through = texelFetch(pane_colour, pixel, 0).rgb;
  imageStore(joined, pixel, vec4(mix(before, through, glass_point(pixel).on_glass), 1.0));
}
