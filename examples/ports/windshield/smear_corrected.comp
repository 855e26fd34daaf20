// windshield.smear, corrected. The thin film that blades leave in streaks along their way, and what of it is not dry yet.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
layout(std140, binding = 0) uniform SmearUniforms {
  vec3 frame;           //   0  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  float edge_width;     //  12  [m] Width over which coverage falls at a blade's edge.
  float inverse_water;  //  16  [1/mm] 1 over the height of water that takes all of the film up.
  float drying;         //  20  [1/s] What of the thickness dries in a second.
  int wiper_count;      //  24  [1] Wipers in the list.
  float padding_0;      //  28  padding
} u;
#include "segment.glsl"
#include "wiper_record.glsl"
layout(binding = 1) uniform sampler2D heights;
layout(binding = 2) uniform sampler2D wiped;
layout(binding = 3) uniform sampler2D laid;
layout(std430, binding = 4) readonly buffer WiperBuffer { Wiper wipers[]; };
layout(binding = 5) uniform sampler2D profile;
layout(binding = 6) uniform writeonly image2D smear;
layout(binding = 7) uniform writeonly image2D next_laid;

// Of the annular sector that the blade swept, p from its pivot: as in wipe_texture.
float sector_distance(Wiper w, vec2 p) {
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
  if (outside(texel, imageSize(smear))) return;
  vec2 at = vec2(texel) + 0.5, place = vec2(u.frame.x * at.x + u.frame.y * at.y, u.frame.z * at.y);
  vec3 film = texelFetch(laid, texel, 0).xyz;  // along the blade, and thickness
  for (int i = 0; i < u.wiper_count; ++i) {
    Wiper w = wipers[i];
    vec2 p = place - w.pivot;
    float covered = clamp(0.5 + (w.half_width - sector_distance(w, p)) / u.edge_width, 0.0, 1.0);
    float r = length(p), along = (r - w.inner_radius) / (w.outer_radius - w.inner_radius);
    float thickness = textureLod(profile, vec2(clamp(along, 0.0, 1.0), 0.5), 0.0).x;
    film = mix(film, vec3(p * (1.0 / max(r, 1e-6)), thickness), covered);
  }
  float taken = min(texelFetch(heights, texel, 0).x * u.inverse_water, 1.0);
  film.z *= 1.0 - taken;
  imageStore(next_laid, texel, vec4(film, 1.0));
  film.z = max(film.z - u.drying * texelFetch(wiped, texel, 0).x, 0.0);
  imageStore(smear, texel, vec4(film, 1.0));
}
