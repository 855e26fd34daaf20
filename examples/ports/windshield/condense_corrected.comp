// windshield.condense, corrected. The mist of condensed water on the glass, as it has grown since water or a blade last cleared it.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
layout(std140, binding = 0) uniform CondenseUniforms {
  float dt;             //   0  [s] Time since the frame before, so rounded that sums are exact.
  float inverse_tau;    //   4  [1/s] 1 over the time constant of the mist.
  float limit;          //   8  [s] The time since the glass was cleared grows to this and no further.
  float wiped_limit;    //  12  [s] Time since a wipe of glass that was never wiped.
  float most;           //  16  [1] What the mist grows to: share of the light that it scatters.
  float inverse_water;  //  20  [1/mm] 1 over the height of water that takes all of the mist up.
  float padding_0;      //  24  padding
  float padding_1;      //  28  padding
} u;
layout(binding = 1) uniform sampler2D height;
layout(binding = 2) uniform sampler2D wiped;
layout(binding = 3) uniform sampler2D clear_time;
layout(binding = 4) uniform writeonly image2D condensation;
layout(binding = 5) uniform writeonly image2D new_clear_time;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(condensation))) return;
  float taken = min(texelFetch(height, texel, 0).x * u.inverse_water, 1.0);
  float grown = min(texelFetch(clear_time, texel, 0).x + u.dt, u.limit) * (1.0 - taken);
  float since_wipe = texelFetch(wiped, texel, 0).x;
  float since = min(grown, since_wipe < u.wiped_limit ? since_wipe : u.limit);
  float mist = u.most * (1.0 - exp(-(since * u.inverse_tau)));
  imageStore(condensation, texel, vec4(mist, 0.0, 0.0, 0.0));
  imageStore(new_clear_time, texel, vec4(since, 0.0, 0.0, 0.0));
}
