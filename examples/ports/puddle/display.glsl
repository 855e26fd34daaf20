// What both displays share.
layout(std140, binding = 0) uniform DisplayUniforms {
  float vignette;  //   0  [1] Loss at distance 1 from the centre.
  float exposure;  //   4  [1] corrected: factor of the radiance.
  float width;     //   8  [pixel] Columns of the picture.
  float height;    //  12  [pixel] Rows of the picture.
} u;
layout(binding = 1) uniform sampler2D colour;
layout(binding = 2) uniform writeonly image2D picture;

float vignette(ivec2 pixel) {
  vec2 size = vec2(u.width, u.height), place = vec2(pixel) + 0.5;
  vec2 offset = place / size - 0.5;
  return 1.0 - u.vignette * length(offset);
}
