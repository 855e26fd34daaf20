// What both composites share.
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
} u;

struct Glint {
  vec3 direction;   //   0  [1] Unit, toward the light, camera axes: right, up, forward.
  float padding_0;  //  12  padding
  vec3 radiance;    //  16  [1] Linear RGB.
  float padding_1;  //  28  padding
};

struct GlassPoint {
  vec2 place;      // on the image plane at distance 1
  float distance;  // along the view axis to the glass [m]
  vec2 uv;
  float on_glass;
};

GlassPoint glass_point(ivec2 pixel) {
  vec3 at = vec3(vec2(pixel) + 0.5, 1.0);
  float toward = dot(u.w_row, at), inverse = 1.0 / max(toward, 1e-6);
  vec2 uv = vec2(dot(u.u_row, at), dot(u.v_row, at)) * inverse;
  bool on = toward > 1e-6 && all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0)));
  return GlassPoint(at.xy * u.pixel - u.half_size, u.glass_distance * inverse, clamp(uv, 0.0, 1.0), on ? 1.0 : 0.0);
}

vec2 scene_at(vec2 place) { return 0.5 + place * u.scene_scale; }

vec3 to_camera(vec3 glass) { return glass.x * u.plane_x + glass.y * u.plane_y + glass.z * u.outward; }

float shown(float height) {
  float t = clamp((height - u.visible_from) / (u.visible_to - u.visible_from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

float highlight(vec3 normal, vec3 to_light, vec3 to_eye) {
  vec3 sum = to_light + to_eye;
  float cosine = clamp(dot(normal, sum) / max(length(sum), 1e-4), 0.0, 1.0);
  return pow(max(cosine, 1e-4), u.shininess);
}
