// What both blur_pyramids share. Seeded bugs of both: 1581 to 1599.
layout(std140, binding = 0) uniform BlurUniforms {
@BLUR
} u;
layout(binding = 1) uniform sampler2D scene_colour;
layout(binding = 2) uniform sampler2D scene_depth;
layout(binding = 3) uniform sampler2D above;
layout(binding = 4) uniform writeonly image2D level;

vec4 fogged(ivec2 texel) {
  float depth = texelFetch(scene_depth, texel, 0).x, seen = exp(-(u.fog_density * max(depth, 0.0)));
  if (BUG == 1583) seen = 1.0 - seen;
  if (BUG == 1584) seen = exp2(-u.fog_density * depth);
  return vec4(mix(u.fog_colour, texelFetch(scene_colour, texel, 0).rgb, seen), 1.0);
}
vec4 tap(ivec2 texel, int i, int j) { return texelFetch(above, min(2 * texel + ivec2(i, j), u.source_size - 1), 0); }
