// puddle.shade, as-published. The light from water, from ground below it, or from the sky.
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
layout(binding = 3) uniform sampler2D noise;
layout(binding = 4) uniform sampler2D environment;
layout(binding = 5) uniform sampler2D ground;
layout(binding = 6) uniform writeonly image2D colour;
#include "sky.glsl"

const vec3 GAMMA = vec3(2.2);

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec3 view = sight(here);
  vec4 surface = texelFetch(normal, here, 0);
  if (!(surface.w > 0.5)) {
    vec3 open = pow(sky(view, 0.0), GAMMA);
    imageStore(colour, here, vec4(open, 1.0));
    return;
  }
  vec3 place = texelFetch(hit, here, 0).xyz;
  vec3 up = surface.xyz;

  float f0 = (1.0 - 1.333) / (1.0 + 1.333);
  f0 *= f0;
  float grazing = 1.0 - min(abs(dot(view, up)), 1.0);
  float square = grazing * grazing;
  float fresnel = f0 + (1.0 - f0) * (square * square * grazing);

  vec3 bounced = reflect(view, up);
  vec3 mirror = pow(sky(bounced, 0.0), GAMMA);

  vec3 bent = refract(view, up, 1.0 / 1.333);
  float reach = -1.0;
  if (abs(bent.y) >= 0.0001) reach = (-given.puddle_depth - place.y) / bent.y;
  if (reach <= 0.0) reach = -1.0;

  vec3 below = 0.3 * given.tint;
  if (reach > 0.0) {
    vec2 bottom = place.xz + reach * bent.xz;
    vec3 floor_colour;
    if (given.use_checkerboard != 0) {
      float grain = texelFetch(noise, here, 0).r - 0.5;
      floor_colour = tiles(bottom) + grain * 0.05;
    } else {
      floor_colour = 0.6 * pow(textureLod(ground, bottom * given.ground_scale, 0.0).rgb, GAMMA);
    }
    float clear = exp(-given.water_turbidity * reach);
    below = (0.7 * (1.0 - 0.5 * given.tint)) * mix(given.tint, floor_colour, clear);
  }

  float share = 0.3 + fresnel * (mix(0.3, 0.8, given.reflectivity) - 0.3);
  vec3 light = mix(below, mirror, share);
  light += (0.15 * (1.0 - fresnel)) * given.tint;
  float haze = exp(-given.fog_depth * length(place - given.camera_position));
  light = mix(0.7 * light, light, haze);
  imageStore(colour, here, vec4(light, 1.0));
}
