// What both blur_pyramids share.
layout(std140, binding = 0) uniform BlurUniforms {
  vec3 fog_colour;    //   0  [1] Linear radiance of the fog.
  float fog_density;  //  12  [1/m] Extinction of light in the fog.
  vec2 middle;        //  16  [1] corrected: weight of the middle one of three texels, for columns and rows.
  vec2 last;          //  24  [1] corrected: weight of the last one, over output index + 1.
  ivec2 source_size;  //  32  [texel] Columns and rows of the level above.
  int level;          //  40  [1] 0 fogs the scene, further ones halve the level above.
  float padding_0;    //  44  padding
} u;
layout(binding = 1) uniform sampler2D scene_colour;
layout(binding = 2) uniform sampler2D scene_depth;
layout(binding = 3) uniform sampler2D above;
layout(binding = 4) uniform writeonly image2D level;

vec4 fogged(ivec2 texel) {
  float depth = texelFetch(scene_depth, texel, 0).x, seen = exp(-(u.fog_density * max(depth, 0.0)));
  return vec4(mix(u.fog_colour, texelFetch(scene_colour, texel, 0).rgb, seen), 1.0);
}
vec4 tap(ivec2 texel, int i, int j) { return texelFetch(above, min(2 * texel + ivec2(i, j), u.source_size - 1), 0); }
