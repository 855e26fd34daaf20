// windshield.normals, corrected. Normals of the water from its heights.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform NormalsUniforms {
  float slope_x;      //   0  [1/mm] Slope along x for 1 mm across two columns.
  float slope_shear;  //   4  [1/mm] Slope along y for 1 mm across two columns; 0 as published.
  float slope_y;      //   8  [1/mm] Slope along y for 1 mm across two rows.
  float padding_0;    //  12  padding
} given;
layout(binding = 1) uniform sampler2D height;
layout(binding = 2) uniform sampler2D mask;
layout(binding = 3) uniform writeonly image2D normal;

ivec2 extent = textureSize(height, 0);
float water(ivec2 place) { return texelFetch(height, clamp(place, ivec2(0), extent - 1), 0).r; }

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, extent))) return;
  float wet = 1.0 - texelFetch(mask, here, 0).r;
  vec2 rise;
  rise.x = water(here + ivec2(1, 0)) - water(here - ivec2(1, 0));
  rise.y = water(here + ivec2(0, 1)) - water(here - ivec2(0, 1));
  mat2 to_slopes = mat2(given.slope_x, given.slope_shear, 0.0, given.slope_y);
  vec2 slope = to_slopes * rise;
  vec3 direction = normalize(vec3(-wet * slope, 1.0));
  imageStore(normal, here, vec4(direction, 1.0));
}
