// puddle.shade, corrected. The light from water and wet ground, or from the sky.
#version 450
#extension GL_GOOGLE_include_directive : enable
layout(local_size_x = 8, local_size_y = 8) in;

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
} given;
layout(binding = 1) uniform sampler2D hit;
layout(binding = 2) uniform sampler2D normal;
layout(binding = 3) uniform sampler2D environment;
layout(binding = 4) uniform sampler2D ground;
layout(binding = 5) uniform sampler2D relief;
layout(binding = 6) uniform sampler2D bed;
layout(binding = 7) uniform writeonly image2D colour;
#include "sky.glsl"

const float INDEX = 1.333;

// What light of the angle's cosine c is thrown back, of all that falls on the water.
float thrown_back(float c) {
  if (given.exact_fresnel == 0) {
    float f0 = (1.0 - INDEX) / (1.0 + INDEX);
    f0 = f0 * f0;
    float m = 1.0 - c;
    return f0 + (1.0 - f0) * (m * m * (m * m) * m);
  }
  float t = sqrt(max(1.0 - (1.0 - c * c) * (1.0 / (INDEX * INDEX)), 0.0));
  vec2 both = vec2((INDEX * c - t) / (INDEX * c + t), (c - INDEX * t) / (c + INDEX * t));
  return 0.5 * dot(both, both);
}
// How many of four bounds a value reaches.
float reached(float value, vec4 bounds) { return dot(vec4(greaterThanEqual(vec4(value), bounds)), vec4(1.0)); }

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec3 view = sight(here);
  vec4 surface = texelFetch(normal, here, 0);
  if (surface.w <= 0.5) {
    imageStore(colour, here, vec4(sky(view, given.background_level), 1.0));
    return;
  }
  vec3 place = texelFetch(hit, here, 0).xyz;
  float range = length(place - given.camera_position);
  vec2 plan = place.xz * given.inverse_size;

  float depth = textureLod(bed, plan + 0.5, 0.0).r;
  float wet = smoothstep(0.0, given.shore_width, depth);

  float footprint = given.ground_footprint * range / max(-view.y, 0.02);
  vec4 bounds = 1.41421356 * vec4(1.0, 2.0, 4.0, 8.0);
  float level = reached(footprint, bounds) + reached(footprint, 16.0 * bounds) + reached(footprint, 256.0 * bounds);

  vec3 up = surface.xyz;
  if (wet < 1.0) {
    vec2 slope = textureLod(relief, place.xz * given.ground_scale, level).xy;
    up = normalize(mix(vec3(slope.x, 1.0, slope.y), up, wet));
  }

  float facing = clamp(-dot(view, up), 0.001, 1.0);
  float fresnel = thrown_back(facing) * (given.reflectivity * mix(given.wetness, 1.0, wet));
  vec3 bounced = reflect(view, up);
  bounced.y = abs(bounced.y);
  vec3 mirror = sky(bounced, mix(given.gloss_level, given.mirror_level, wet));

  vec3 bent = refract(view, up, 1.0 / INDEX);
  float column = max(depth, 0.0);
  float path = column / max(-bent.y, 0.05);
  vec2 bottom = place.xz + path * bent.xz;
  vec3 albedo = given.use_checkerboard != 0 ? tiles(bottom) : textureLod(ground, bottom * given.ground_scale, level).rgb;
  if (column > 0.0) {
    float clear = exp(-(given.water_turbidity * (path + column)));
    albedo = mix(given.tint, albedo, clear);
  }

  vec3 light = fresnel * mirror + (1.0 - fresnel) * (albedo * given.ambient);
  if (given.fog_depth > 0.0) {
    float haze = exp(-(given.fog_depth * range));
    light = mix(given.fog_colour, light, haze);
  }
  if (given.ground_reach > 0.0) {
    vec2 beyond = max(abs(plan) - 0.5, 0.0);
    float gone = smoothstep(0.0, given.ground_reach, length(beyond));
    light = mix(light, sky(view, given.background_level), gone);
  }
  imageStore(colour, here, vec4(light, 1.0));
}
