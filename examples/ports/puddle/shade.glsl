// What both versions of shade share.
layout(std140, binding = 0) uniform ShadeUniforms {
  vec3 camera_position;       //   0  [m] Eye.
  float camera_pixel_scale;   //  12  [1] Height of a pixel on the image plane at distance 1.
  vec3 camera_right;          //  16  [1] Unit vector to the right of the picture.
  float camera_plane_left;    //  28  [1] Left edge of the image plane at distance 1.
  vec3 camera_up;             //  32  [1] Unit vector to the top of the picture.
  float camera_plane_bottom;  //  44  [1] Bottom edge of the image plane at distance 1.
  vec3 camera_forward;        //  48  [1] Unit vector into the picture.
  float padding_0;            //  60  padding
  vec3 tint;                  //  64  [1] Colour of the water's body, linear RGB.
  float reflectivity;         //  76  [1] Weight of the reflection.
  vec2 rotation;              //  80  [1] Cosine and sine of env_rotation.
  float ground_scale;         //  88  [1/m] Tiles of the ground in a metre.
  float water_turbidity;      //  92  [1/m] Extinction of light in the water.
  float puddle_depth;         //  96  [m] as-published: depth of the ground under y = 0.
  float fog_depth;            // 100  [1/m] Extinction of the fog.
  int use_checkerboard;       // 104  [1] 1: checkerboard ground, 0: image.
  int environment_is_cube;    // 108  [1] 1: cube faces, 0: latitude/longitude.
  vec3 ambient;               // 112  [1] corrected: radiance of a white diffuse level ground.
  float gloss_level;          // 124  [1] corrected: mip level of the environment in wet ground.
  vec2 inverse_size;          // 128  [1/m] corrected: 1 over the puddle's extent in x and z.
  float shore_width;          // 136  [m] corrected: depth over which wet ground turns into water.
  float ground_footprint;     // 140  [1/m] corrected: texels of the ground under a pixel at distance 1.
  vec3 fog_colour;            // 144  [1] corrected: radiance of the fog.
  int exact_fresnel;          // 156  [1] corrected: 1: Fresnel's equations, 0: Schlick.
  float wetness;              // 160  [1] corrected: reflectance of the wet ground over that of water.
  float background_level;     // 164  [1] corrected: mip level of the environment behind the scene.
  float mirror_level;         // 168  [1] corrected: mip level of the environment in the water.
  float ground_reach;         // 172  [1] corrected: extents of the puddle over which the ground turns into the environment's; 0: never.
} u;
const float PI = 3.14159265358979;
const float WATER_IOR = 1.333;

float schlick(float cosine) {
  float f0 = (1.0 - WATER_IOR) / (1.0 + WATER_IOR);
  f0 *= f0;
  float m = 1.0 - cosine, m2 = m * m;
  float m5 = m2 * m2 * m;
  return f0 + (1.0 - f0) * m5;
}
float transmittance(float extinction, float path) { return exp(-extinction * path); }

// By -env_rotation about y.
vec3 rotate(vec3 d) {
  float c = u.rotation.x, s = u.rotation.y;
  return vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

vec2 latlong_place(vec3 d) {
  float azimuth = atan(d.z, d.x), elevation = atan(d.y, length(d.xz));
  vec2 place = vec2(0.5 + azimuth / (2.0 * PI), 0.5 + elevation / PI);
  return place;
}

// Six square faces in one column; nothing is filtered over an edge, and the level is the nearest one.
vec3 cube(vec3 d, float lod) {
  vec3 a = abs(d);
  float face, major;
  vec2 place;
  if (a.x >= a.y && a.x >= a.z) {
    face = d.x < 0.0 ? 1.0 : 0.0;
    place = vec2(d.x < 0.0 ? d.z : -d.z, -d.y);
    major = a.x;
  } else if (a.y >= a.z) {
    face = d.y < 0.0 ? 3.0 : 2.0;
    place = vec2(d.x, d.y < 0.0 ? -d.z : d.z);
    major = a.y;
  } else {
    face = d.z < 0.0 ? 5.0 : 4.0;
    place = vec2(d.z < 0.0 ? -d.x : d.x, -d.y);
    major = a.z;
  }
  float level = floor(clamp(lod, 0.0, float(textureQueryLevels(environment) - 1)) + 0.5);
  // Not textureSize of the level: lavapipe gives every invocation of a group the size of the first one's level.
  float edge = 0.5 / float(max(textureSize(environment, 0).x >> int(level), 1));
  place = clamp(0.5 * place / major + 0.5, edge, 1.0 - edge);
  return textureLod(environment, vec2(place.x, (face + place.y) / 6.0), level).rgb;
}
vec3 sample_environment(vec3 d, float lod) {
  d = rotate(d);
  return u.environment_is_cube != 0 ? cube(d, lod) : textureLod(environment, latlong_place(d), lod).rgb;
}

vec3 checkerboard(vec2 place) {
  float parity = mod(floor(place.x * u.ground_scale) + floor(place.y * u.ground_scale), 2.0);
  return mix(vec3(0.15, 0.12, 0.10), vec3(0.25, 0.22, 0.20), parity);
}
