// What both normals share.
layout(std140, binding = 0) uniform NormalsUniforms {
  float slope_x;      //   0  [1/mm] Slope along x for 1 mm across two columns.
  float slope_shear;  //   4  [1/mm] Slope along y for 1 mm across two columns; 0 as published.
  float slope_y;      //   8  [1/mm] Slope along y for 1 mm across two rows.
  float padding_0;    //  12  padding
} u;
layout(binding = 1) uniform sampler2D heights;
layout(binding = 2) uniform sampler2D mask;
layout(binding = 3) uniform writeonly image2D normals;

ivec2 held(ivec2 at) {
  ivec2 size = textureSize(heights, 0);
  return clamp(at, ivec2(0), size - 1);
}
float height_at(ivec2 at) { return texelFetch(heights, held(at), 0).x; }
float dry_at(ivec2 at) { return 1.0 - texelFetch(mask, held(at), 0).x; }

void store_normal(ivec2 texel, vec2 across, float kept) {
  vec2 slope = kept * vec2(u.slope_x * across.x, u.slope_shear * across.x + u.slope_y * across.y);
  vec3 normal = normalize(vec3(-slope, 1.0));
  imageStore(normals, texel, vec4(normal, 1.0));
}
