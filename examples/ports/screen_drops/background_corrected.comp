// screen_drops.background, corrected. The scene out of focus, without water. Once, before frame 0.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform BackgroundUniforms {
  vec2 resolution;  //   0  [pixel] as-published: columns and rows of the picture.
  float level;      //   8  [1] Mip level of the lookups.
  float weight;     //  12  [1] corrected: of a tap.
  vec2 scale;       //  16  [1] corrected: texture coordinates of the scene in a pixel.
  vec2 offset;      //  24  [1] corrected: those of the picture's corner.
  int tap_count;    //  32  [1] corrected: taps in the list.
  float padding_0;  //  36  padding
  float padding_1;  //  40  padding
  float padding_2;  //  44  padding
} u;

struct Tap {
  float x;          //   0  [1] From the pixel's place, in texture coordinates of the scene.
  float y;          //   4  [1] See x.
  float padding_0;  //   8  padding
  float padding_1;  //  12  padding
};
layout(binding = 1) uniform sampler2D scene;
layout(std430, binding = 2) readonly buffer Taps { Tap taps[]; };
layout(binding = 3) uniform writeonly image2D background;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(background))) return;
  vec2 at = (vec2(pixel) + 0.5) * u.scale + u.offset;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < u.tap_count; ++k) sum += textureLod(scene, at + vec2(taps[k].x, taps[k].y), u.level).rgb;
  imageStore(background, pixel, vec4(u.weight * sum, 1.0));
}
