// windshield.wipe_texture, corrected. What the blades take off the height, and the mask of freshly wiped glass.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "wipe_texture.glsl"
layout(binding = 1) uniform sampler2D heights;
layout(binding = 2) uniform sampler2D wiped;
layout(std430, binding = 3) readonly buffer WiperBuffer { Wiper wipers[]; };
layout(binding = 4) uniform writeonly image2D next_heights;
layout(binding = 5) uniform writeonly image2D mask;
layout(binding = 6) uniform writeonly image2D next_wiped;

// Distance to the annular sector that the blade swept, as the document derives it.
float sector_distance(Wiper w, vec2 at) {
  vec2 p = at - w.pivot;
  float before = segment_distance(p, w.inner_radius * w.previous_axis, w.outer_radius * w.previous_axis);
  float now = segment_distance(p, w.inner_radius * w.axis, w.outer_radius * w.axis);
  float turn = w.direction < 0.0 ? -1.0 : 1.0;
  float after = turn * (p.x * w.previous_axis.y - p.y * w.previous_axis.x), ahead = turn * (p.y * w.axis.x - p.x * w.axis.y);
  float beside = max(max(after, ahead), 0.0), behind = max(-dot(p, w.previous_axis + w.axis), 0.0), r = length(p);
  float between = max(max(w.inner_radius - r, r - w.outer_radius), 0.0) + 2.0 * (beside + behind);
  return min(min(before, now), between);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(next_heights))) return;
  float coverage = 0.0;
  for (int i = 0; i < u.wiper_count; ++i) coverage = max(coverage, coverage_at(sector_distance(wipers[i], in_plane(texel)), wipers[i]));
  float before = texelFetch(wiped, texel, 0).x, since = min(before + u.dt, u.wiped_limit);
  since *= 1.0 - coverage;
  float shown = exp(-(since * u.inverse_tau));
  imageStore(next_heights, texel, vec4(texelFetch(heights, texel, 0).x * (1.0 - coverage), 0.0, 0.0, 0.0));
  imageStore(mask, texel, vec4(shown, 0.0, 0.0, 0.0));
  imageStore(next_wiped, texel, vec4(since, 0.0, 0.0, 0.0));
}
