// windshield.wipe_texture, corrected. Water and time since a wipe, after the blades went by.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

struct Wiper {
  vec2 previous_inner;  //   0  [1] Inner end before the step, glass coordinates.
  vec2 previous_outer;  //   8  [1] Outer end before the step.
  vec2 inner;           //  16  [1] Inner end after it.
  vec2 outer;           //  24  [1] Outer end after it.
  vec2 pivot;           //  32  [m] Plane coordinates.
  float inner_radius;   //  40  [m] Of the inner end, from the pivot.
  float outer_radius;   //  44  [m] Of the outer end.
  vec2 previous_axis;   //  48  [1] Cosine and sine of the blade's angle before the step.
  vec2 axis;            //  56  [1] The same after it.
  float half_width;     //  64  [m] Half the width that the blade wipes.
  float rate;           //  68  [rad/s] Turned angle over the time that the record stands for.
  float direction;      //  72  [1] Sign of rate; 0 at rest.
  float padding_0;      //  76  padding
};

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
} given;

layout(std430, binding = 3) readonly buffer WipersBuffer { Wiper wipers[]; };
layout(binding = 1) uniform sampler2D height;
layout(binding = 2) uniform sampler2D wiped;
layout(binding = 4) uniform writeonly image2D height_out;
layout(binding = 5) uniform writeonly image2D mask;
layout(binding = 6) uniform writeonly image2D wiped_out;

// Squared distance of a place, seen from the pivot, to a blade along an axis.
float to_blade(vec2 from_pivot, vec2 axis, float inner, float outer) {
  vec2 start = inner * axis;
  vec2 span = outer * axis - start;
  vec2 offset = from_pivot - start;
  float along = clamp(dot(offset, span) / max(dot(span, span), 1e-12), 0.0, 1.0);
  vec2 off = offset - along * span;
  return dot(off, off);
}
float turn(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(height_out)))) return;
  vec2 centre = vec2(here) + 0.5;
  vec2 place = vec2(given.frame.x * centre.x + given.frame.y * centre.y, given.frame.z * centre.y);

  float covered = 0.0;
  for (int k = 0; k < given.wiper_count; ++k) {
    vec2 arm = place - wipers[k].pivot;
    float far = length(arm);
    vec2 before = wipers[k].previous_axis;
    vec2 now = wipers[k].axis;
    float sense = wipers[k].direction < 0.0 ? -1.0 : 1.0;
    float beside = max(max(sense * turn(arm, before), sense * turn(now, arm)), 0.0);
    float behind = max(-dot(arm, before + now), 0.0);
    float ring = max(max(wipers[k].inner_radius - far, far - wipers[k].outer_radius), 0.0);
    float distance_to = ring + 2.0 * (beside + behind);
    float blade_before = to_blade(arm, before, wipers[k].inner_radius, wipers[k].outer_radius);
    float blade_now = to_blade(arm, now, wipers[k].inner_radius, wipers[k].outer_radius);
    distance_to = min(distance_to, sqrt(min(blade_before, blade_now)));
    float cover = clamp(0.5 + (wipers[k].half_width - distance_to) / given.edge_width, 0.0, 1.0);
    covered = max(covered, cover);
  }

  float left = 1.0 - covered;
  float water = texelFetch(height, here, 0).r * left;
  float since = min(texelFetch(wiped, here, 0).r + given.dt, given.wiped_limit) * left;
  float dry = exp(-(since * given.inverse_tau));
  imageStore(height_out, here, vec4(water, 0.0, 0.0, 0.0));
  imageStore(mask, here, vec4(dry, 0.0, 0.0, 0.0));
  imageStore(wiped_out, here, vec4(since, 0.0, 0.0, 0.0));
}
