// windshield.mist, corrected. What composite made of the scene, and through the mist on the glass a blurred and veiled one.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
layout(std140, binding = 0) uniform MistUniforms {
  vec3 u_row;            //   0  [1] u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y).
  float glass_distance;  //  12  [m] As composite's.
  vec3 v_row;            //  16  [1] v likewise.
  float lod;             //  28  [1] Mip level of the lookups at the taps.
  vec3 w_row;            //  32  [1] See u_row; positive where the glass lies before the eye.
  float veil;            //  44  [1] Share of the light in the mist that comes from all the scene.
  vec2 pixel;            //  48  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;        //  56  [1] Half the extent of the image plane at distance 1.
  vec2 scene_scale;      //  64  [1] Texture coordinates of the scene per unit of the image plane.
  float weight;          //  72  [1] Of a tap.
  int tap_count;         //  76  [1] Taps in the list.
} u;
struct Tap {
  float x;          //   0  [1] From the pixel's place, in texture coordinates of the scene.
  float y;          //   4  [1] See x.
  float padding_0;  //   8  padding
  float padding_1;  //  12  padding
};
layout(binding = 1) uniform sampler2D pyramid;
layout(std430, binding = 2) readonly buffer Taps { Tap taps[]; };
layout(binding = 3) uniform sampler2D condensation;
layout(binding = 4) uniform sampler2D colour;
layout(binding = 5) uniform writeonly image2D misted;

const float COARSEST = 15.0;  // of every pyramid: a lookup goes no further than the last level

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(misted))) return;
  vec3 q = vec3(vec2(pixel) + 0.5, 1.0);
  float toward = dot(u.w_row, q);
  vec2 uv = vec2(dot(u.u_row, q), dot(u.v_row, q)) * (1.0 / max(toward, 1e-6));
  bool on_glass = toward > 1e-6 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0)));
  vec2 at = 0.5 + (q.xy * u.pixel - u.half_size) * u.scene_scale;
  float share = textureLod(condensation, clamp(uv, 0.0, 1.0), 0.0).x;
  if (!on_glass) share = 0.0;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < u.tap_count; ++k) sum += textureLod(pyramid, at + vec2(taps[k].x, taps[k].y), u.lod).rgb;
  vec3 blur = u.weight * sum, veil = textureLod(pyramid, at, COARSEST).rgb;
  vec3 scattered = mix(blur, veil, u.veil);
  imageStore(misted, pixel, vec4(mix(texelFetch(colour, pixel, 0).rgb, scattered, share), 1.0));
}
