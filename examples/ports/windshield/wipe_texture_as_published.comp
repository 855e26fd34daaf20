// windshield.wipe_texture, as-published. What the blades take off the height, and the mask of freshly wiped glass.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "wipe_texture.glsl"
layout(binding = 1) uniform sampler2D heights;
layout(binding = 2) uniform sampler2D mask;
layout(std430, binding = 3) readonly buffer WiperBuffer { Wiper wipers[]; };
layout(binding = 4) uniform writeonly image2D next_heights;
layout(binding = 5) uniform writeonly image2D next_mask;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(next_heights))) return;
  float coverage = 0.0;
  for (int i = 0; i < u.wiper_count; ++i) {
    Wiper w = wipers[i];
    vec2 inner = w.inner * u.axis_length;
    vec2 outer = w.outer * u.axis_length;
    coverage = max(coverage, coverage_at(segment_distance(in_plane(texel), inner, outer), w));
  }
  float height = max(texelFetch(heights, texel, 0).x - u.strength * coverage, 0.0);
  float wiped = texelFetch(mask, texel, 0).x;
  float next = max(wiped * u.keep, coverage);
  imageStore(next_heights, texel, vec4(height, 0.0, 0.0, 0.0));
  imageStore(next_mask, texel, vec4(next, 0.0, 0.0, 0.0));
}
