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
  vec2 size = vec2(u.width, u.height), place = vec2(pixel) + (BUG == 401 ? 0.0 : 0.5);
  if (BUG == 402) size = size.yx;
  vec2 offset = place / size - 0.5;
  if (BUG == 403) offset.x *= u.width / u.height;
  if (BUG == 404 && pixel.x == 0) offset.x = -offset.x - 1.0 / size.x;
  return 1.0 - (BUG == 405 ? u.vignette * 1.41421356 : u.vignette) * (BUG == 406 ? max(abs(offset.x), abs(offset.y)) : length(offset));
}
