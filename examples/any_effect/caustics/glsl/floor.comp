// caustics.floor in GLSL.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform Floor {
  vec3 absorption;  //   0  [1/texel] Of the water, linear RGB.
  float depth;      //  12  [texel] Of still water.
  vec2 view;        //  16  [texel] From a texel to what the eye sees below it through still water.
  float tile;       //  24  [texel] Side of a tile.
  float ambient;    //  28  [1] Light that comes from everywhere; the sun's is 1.
  vec3 sky;         //  32  [1] What the water mirrors, linear RGB.
  int rounds;       //  44  [1] Steps of the search for the ray that lands on a place.
} u;
layout(binding = 1) uniform sampler2D rays;
layout(binding = 2) uniform sampler2D mirror;
layout(binding = 3) uniform sampler2D tiles;
layout(binding = 4, rgba8) uniform writeonly image2D picture;

vec4 ray_from(vec2 place) { return textureLod(rays, place / vec2(textureSize(rays, 0)), 0.0); }

// The sun's ray that lands on a place of the floor.
vec4 ray_to(vec2 place) {
  vec4 ray = ray_from(place);
  for (int k = u.rounds; k > 0; --k) ray = ray_from(place - ray.xy);
  return ray;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(picture)))) return;

  vec2 across = texelFetch(rays, pixel, 0).xy + u.view;
  vec2 place = across + (vec2(pixel) + 0.5);
  vec4 ray = ray_to(place);
  float lit = u.ambient + ray.w * ray.z;

  float path = u.depth + sqrt(dot(across, across) + u.depth * u.depth);
  vec3 left = exp(-path * u.absorption);
  vec3 from_floor = textureLod(tiles, place / u.tile, 0.0).rgb * lit * left;
  vec3 colour = mix(from_floor, u.sky, texelFetch(mirror, pixel, 0).r);
  imageStore(picture, pixel, vec4(sqrt(clamp(colour, 0.0, 1.0)), 1.0));
}
