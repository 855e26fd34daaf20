// windshield.composite, as-published. What the eye sees through the glass.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

struct Glint {
  vec3 direction;   //   0  [1] Unit, toward the light, camera axes: right, up, forward.
  float padding_0;  //  12  padding
  vec3 radiance;    //  16  [1] Linear RGB.
  float padding_1;  //  28  padding
};

layout(std140, binding = 0) uniform CompositeUniforms {
  vec3 u_row;            //   0  [1] u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y).
  float glass_distance;  //  12  [m] The glass lies glass_distance / w_row . (x, y, 1) along the view axis.
  vec3 v_row;            //  16  [1] v likewise.
  float blur_lod;        //  28  [1] Mip level of the picture behind the film.
  vec3 w_row;            //  32  [1] See u_row; positive where the glass lies before the eye.
  float wetness;         //  44  [1] Weight of the blurred picture where the glass was not wiped.
  vec3 plane_x;          //  48  [1] First axis of the glass's plane, camera axes: right, up, forward.
  float visible_from;    //  60  [mm] Height at which water begins to show as a drop.
  vec3 plane_y;          //  64  [1] Second axis.
  float visible_to;      //  76  [mm] Height from which it shows fully.
  vec3 outward;          //  80  [1] Normal of the glass, away from the car.
  float refraction;      //  92  [1] as-published: offset in pictures per unit of n.xy.
  vec2 pixel;            //  96  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;        // 104  [1] Half the extent of the image plane at distance 1.
  vec2 scene_scale;      // 112  [1] Texture coordinates of the scene per unit of the image plane.
  float shininess;       // 120  [1] Power of a highlight.
  float glint_strength;  // 124  [1] Weight of the highlights.
  vec3 cabin;            // 128  [1] Radiance beside the glass.
  int glint_count;       // 140  [1] Lights in the list.
  float water_ior;       // 144  [1] corrected: refractive index of the water.
  float inner;           // 148  [1] corrected: share of the blurred scene that the water's surface mirrors.
  float padding_0;       // 152  padding
  float padding_1;       // 156  padding
} given;

layout(std430, binding = 5) readonly buffer GlintsBuffer { Glint glints[]; };
layout(binding = 1) uniform sampler2D blurred;
layout(binding = 2) uniform sampler2D height;
layout(binding = 3) uniform sampler2D normal;
layout(binding = 4) uniform sampler2D mask;
layout(binding = 6) uniform writeonly image2D colour;

float ramp(float low, float high, float x) {
  float t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
// The blurred scene at a place of the picture.
vec3 behind(vec2 place, float level) { return textureLod(blurred, place, level).rgb; }

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec3 q = vec3(vec2(here) + 0.5, 1.0);
  vec3 projected = q * mat3(given.u_row, given.v_row, given.w_row);
  float m = projected.z;
  float inverse = 1.0 / max(m, 1e-6);
  vec2 place = projected.xy * inverse;
  vec2 held = clamp(place, 0.0, 1.0);
  if (m <= 1e-6 || held != place) {
    imageStore(colour, here, vec4(given.cabin, 1.0));
    return;
  }
  vec2 plane = q.xy * given.pixel - given.half_size;

  vec3 slope = textureLod(normal, held, 0.0).xyz;
  slope.z = max(slope.z, 0.05);
  float water = textureLod(height, held, 0.0).r;
  float wiped = clamp(textureLod(mask, held, 0.0).r, 0.0, 1.0);
  float wet = 1.0 - wiped;
  float visible = ramp(given.visible_from, given.visible_to, water) * wet;

  vec2 straight = plane * given.scene_scale + 0.5;
  vec2 bent = straight + (given.refraction * visible) * slope.xy;
  vec3 dry = mix(behind(straight, 0.0), behind(straight, given.blur_lod), given.wetness * wet);
  vec3 seen = mix(dry, behind(bent, 0.0), visible);

  if (visible > 0.0) {
    mat3 axes = mat3(given.plane_x, given.plane_y, given.outward);
    vec3 facing = -(axes * slope);
    vec3 eye = -normalize(vec3(plane, 1.0));
    for (int k = 0; k < given.glint_count; ++k) {
      vec3 half_way = glints[k].direction + eye;
      float cosine = dot(facing, half_way) / max(length(half_way), 1e-4);
      float shine = pow(max(clamp(cosine, 0.0, 1.0), 1e-4), given.shininess);
      seen += shine * (given.glint_strength * visible) * glints[k].radiance;
    }
  }
  imageStore(colour, here, vec4(seen, 1.0));
}
