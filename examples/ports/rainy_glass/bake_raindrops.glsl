// The raindrop map; CORRECTED chooses the cells of the time offsets.
#include "port.glsl"

layout(std140, binding = 0) uniform BakeRaindropsUniforms {
  vec2 inverse_size;   //   0  [1] 1 over the map's columns and rows.
  int droplet_count;   //   8  [1] Droplets in the list.
  float normal_scale;  //  12  [1] Slope of the water over the gradient of the height.
  float neutral;       //  16  [1] Stored value of a flat surface's normal.
  float span;          //  20  [1] Stored value of a unit less neutral.
  float padding_0;     //  24  padding
  float padding_1;     //  28  padding
} u;
struct Droplet {
  float x;       //   0  [1] Centre, in tiles.
  float y;       //   4  [1] Centre.
  float radius;  //   8  [1] Of a disc that holds it, in tiles.
  float height;  //  12  [1] At the centre.
  float m00;     //  16  [1] q = M d is 1 long at the rim.
  float m01;     //  20  [1] M is symmetric.
  float m11;     //  24  [1] See m00.
  float offset;  //  28  [1] Of its timer.
};
layout(std430, binding = 1) readonly buffer DropletBuffer { Droplet droplets[]; };
layout(binding = 2) uniform writeonly image2D raindrops;
#include "bake.glsl"

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(raindrops))) return;
  vec2 here = texel_centre(texel), gradient = vec2(0.0);
  float height = 0.0, nearest = 4.0, offset = 0.0;
  for (int k = 0; k < u.droplet_count; ++k) {
    Droplet d = droplets[k];
    vec2 apart = vec2(around(here.x - d.x), around(here.y - d.y));
    vec2 q = vec2(d.m00 * apart.x + d.m01 * apart.y, d.m01 * apart.x + d.m11 * apart.y);
    float h = d.height * (1.0 - dot(q, q));
    if (h > height) {
      height = h;
      gradient = -2.0 * d.height * vec2(d.m00 * q.x + d.m01 * q.y, d.m01 * q.x + d.m11 * q.y);
    }
    float measure = dot(apart, apart);
    if (CORRECTED) measure -= d.radius * d.radius;
    if (measure < nearest) {
      nearest = measure;
      offset = d.offset;
    }
  }
  imageStore(raindrops, texel, vec4(stored_normal(gradient), offset, height));
}
