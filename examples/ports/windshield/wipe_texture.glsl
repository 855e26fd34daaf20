// What both wipe_textures share.
layout(std140, binding = 0) uniform WipeTextureUniforms {
  vec3 frame;         //   0  [m/texel] Plane coordinates of a step: x of a column, x and y of a row.
  float edge_width;   //  12  [m] Width over which coverage falls at a blade's edge.
  vec2 axis_length;   //  16  [m] as-published: lengths of the axes u and v.
  float strength;     //  24  [mm] as-published: what full coverage takes off the height.
  float keep;         //  28  [1] as-published: share of the mask that a frame leaves.
  float dt;           //  32  [s] corrected: time since the frame before, so rounded that sums are exact.
  float inverse_tau;  //  36  [1/s] corrected: 1 over the time constant of the mask.
  float wiped_limit;  //  40  [s] corrected: the time since a wipe grows to this and no further.
  int wiper_count;    //  44  [1] Wipers in the list.
} u;
#include "segment.glsl"
#include "wiper_record.glsl"

float coverage_at(float away, Wiper w) {
  return clamp(0.5 + (w.half_width - away) / u.edge_width, 0.0, 1.0);
}
vec2 in_plane(ivec2 texel) {
  vec2 at = vec2(texel) + 0.5;
  return vec2(u.frame.x * at.x + u.frame.y * at.y, u.frame.z * at.y);
}
