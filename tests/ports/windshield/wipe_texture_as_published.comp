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
  int count = BUG == 1545 ? u.wiper_count - 1 : u.wiper_count;
  for (int i = 0; i < count; ++i) {
    Wiper w = wipers[i];
    vec2 scale = BUG == 1536 ? u.axis_length.yx : u.axis_length;
    vec2 inner = BUG == 1533 ? w.previous_inner : w.inner, outer = BUG == 1533 ? w.previous_outer : w.outer;
    coverage = max(coverage, coverage_at(segment_distance(in_plane(texel), inner * scale, outer * scale), w));
  }
  float height = texelFetch(heights, texel, 0).x - u.strength * coverage, wiped = texelFetch(mask, texel, 0).x;
  if (BUG != 1534) height = max(height, 0.0);
  float next = max(wiped * u.keep, coverage);
  if (BUG == 1532) next = max(wiped - (1.0 - u.keep), coverage);
  if (BUG == 1535) next = wiped * u.keep + coverage;
  if (BUG == 1548) next = max(wiped, coverage) * u.keep;
  imageStore(next_heights, texel, vec4(height, 0.0, 0.0, 0.0));
  imageStore(next_mask, texel, vec4(next, 0.0, 0.0, 0.0));
}
