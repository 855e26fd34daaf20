// screen_drops.cells, corrected. The drop that each cell of four grids holds now.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform CellsUniforms {
  uvec2 seed;       //   0  [1] Low and high word of the seed.
  uint tick;        //   8  [ms] The frame's time, modulo 2^32.
  uint keep;        //  12  [1] Of 65536 cells hold a drop.
  ivec4 columns;    //  16  [cell] Columns of each layer.
  ivec4 rows;       //  32  [cell] Rows of each layer.
  ivec4 first_row;  //  48  [texel] Row of the buffer where each layer begins.
  uint shortest;    //  64  [ms] Shortest cycle.
  uint span;        //  68  [ms] Longest cycle less shortest.
  float largest;    //  72  [cell] Radius of a layer's largest drop.
  float impact;     //  76  [1] Share of the cycle in which a drop spreads.
} u;
layout(binding = 1) uniform writeonly image2D cells;

#include "random.glsl"

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(cells))) return;
  imageStore(cells, texel, vec4(0.0));
  int layer = -1;
  for (int l = 0; l < 4; ++l) {
    int line = texel.y - u.first_row[l];
    if (line >= 0 && line < u.rows[l] && texel.x < u.columns[l]) layer = l;
  }
  if (layer < 0) return;
  uint cell = uint(texel.x) | uint(texel.y - u.first_row[layer]) << 16;
  uvec4 own = random_block(62u, cell, uint(layer));
  uint span = u.shortest + ((own.x >> 16) * u.span >> 16), start = (own.y >> 16) * span >> 16;
  uint time = u.tick + start, cycle = time / span;
  uvec4 drop = random_block(63u, cell, cycle * 4u + uint(layer));
  if ((drop.x >> 16) >= u.keep) return;
  vec4 share = vec4(drop.yzw >> 16, (time % span << 16) / span) / 65536.0;
  float reach = u.largest / sqrt(1.0 + 3.0 * share.x);
  float grown = min(share.w / u.impact, (1.0 - share.w) / (1.0 - u.impact));
  float radius = reach * sqrt(max(grown, 0.0));
  vec2 centre = 0.5 + (share.yz - 0.5) * (1.0 - 2.0 * reach);
  imageStore(cells, texel, vec4(centre, radius, share.w));
}
