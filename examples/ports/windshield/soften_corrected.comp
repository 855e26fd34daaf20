// windshield.soften, corrected. What composite made of the scene, drawn out across the streaks of the film that blades left.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"
layout(std140, binding = 0) uniform SoftenUniforms {
  vec3 u_row;            //   0  [1] u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y).
  float glass_distance;  //  12  [m] As composite's.
  vec3 v_row;            //  16  [1] v likewise.
  float lod;             //  28  [1] Mip level of the lookups.
  vec3 w_row;            //  32  [1] See u_row; positive where the glass lies before the eye.
  float most;            //  44  [1] Share of the light that the thickest streak scatters.
  vec3 plane_x;          //  48  [1] First axis of the glass's plane, camera axes: right, up, forward.
  int deflection_count;  //  60  [1] Deflections in the list.
  vec3 plane_y;          //  64  [1] Second axis.
  float padding_0;       //  76  padding
  vec2 pixel;            //  80  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;        //  88  [1] Half the extent of the image plane at distance 1.
  vec2 scene_scale;      //  96  [1] Texture coordinates of the scene per unit of the image plane.
  float padding_1;       // 104  padding
  float padding_2;       // 108  padding
} u;
struct Deflection {
  float tangent;    //   0  [1] Of the angle, along the blade that left the film.
  float weight;     //   4  [1] Share of the scattered light.
  float padding_0;  //   8  padding
  float padding_1;  //  12  padding
};
layout(binding = 1) uniform sampler2D pyramid;
layout(std430, binding = 2) readonly buffer Deflections { Deflection deflections[]; };
layout(binding = 3) uniform sampler2D smear;
layout(binding = 4) uniform sampler2D colour;
layout(binding = 5) uniform writeonly image2D softened;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(pixel, imageSize(softened))) return;
  vec3 q = vec3(vec2(pixel) + 0.5, 1.0), seen = texelFetch(colour, pixel, 0).rgb;
  float toward = dot(u.w_row, q);
  vec2 uv = vec2(dot(u.u_row, q), dot(u.v_row, q)) * (1.0 / max(toward, 1e-6));
  bool on_glass = toward > 1e-6 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0)));
  vec3 film = textureLod(smear, clamp(uv, 0.0, 1.0), 0.0).xyz;
  float share = u.most * film.z;
  if (!on_glass) share = 0.0;
  if (share > 0.0) {
    vec2 place = q.xy * u.pixel - u.half_size, at = 0.5 + place * u.scene_scale;
    vec3 along = film.x * u.plane_x + film.y * u.plane_y;
    vec2 turned = (along.xy - place * along.z) * u.scene_scale;
    vec3 sum = vec3(0.0);
    for (int k = 0; k < u.deflection_count; ++k)
      sum += deflections[k].weight * textureLod(pyramid, at + deflections[k].tangent * turned, u.lod).rgb;
    seen = mix(seen, sum, share);
  }
  imageStore(softened, pixel, vec4(seen, 1.0));
}
