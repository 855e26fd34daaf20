// windshield.falling_rain, as-published and corrected. Streaks of the rain behind the glass over the fogged scene, in their order.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
#include "segment.glsl"
layout(std140, binding = 0) uniform FallingRainUniforms {
  int streak_count;  //   0  [1] Streaks in the list.
  float sharpness;   //   4  [1/m] 1 over the depth in which what stands in the street hides a streak.
  float padding_0;   //   8  padding
  float padding_1;   //  12  padding
} u;
struct Streak {
  vec2 opened;      //   0  [texel] Its middle when the shutter opens: column and row of the scene's picture.
  vec2 closed;      //   8  [texel] The same when it closes.
  float radius;     //  16  [texel] Half its width, at least half a texel.
  float depth;      //  20  [m] Along the view axis.
  float opacity;    //  24  [1] Share of the exposure and of the width in which it covers a point of its way.
  float padding_0;  //  28  padding
  vec3 radiance;    //  32  [1] Linear RGB.
  float padding_1;  //  44  padding
};
layout(binding = 1) uniform sampler2D scene;
layout(binding = 2) uniform sampler2D scene_depth;
layout(std430, binding = 3) readonly buffer Streaks { Streak streaks[]; };
layout(binding = 4) uniform writeonly image2D rainy;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(rainy))) return;
  vec2 centre = vec2(texel) + 0.5;
  float depth = texelFetch(scene_depth, texel, 0).x;
  vec3 colour = texelFetch(scene, texel, 0).rgb;
  for (int i = 0; i < u.streak_count; ++i) {
    Streak s = streaks[i];
    float covered = clamp(0.5 + (s.radius - segment_distance(centre, s.opened, s.closed)), 0.0, 1.0);
    float before = clamp((depth - s.depth) * u.sharpness, 0.0, 1.0);
    colour = mix(colour, s.radiance, s.opacity * covered * before);
  }
  imageStore(rainy, texel, vec4(colour, 1.0));
}
