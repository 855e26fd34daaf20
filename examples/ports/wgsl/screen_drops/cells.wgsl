// screen_drops.cells, corrected. The drop that each cell of four grids holds now.
struct CellsUniforms {
  seed : vec2<u32>,       //   0  [1] Low and high word of the seed.
  tick : u32,             //   8  [ms] The frame's time, modulo 2^32.
  keep : u32,             //  12  [1] Of 65536 cells hold a drop.
  columns : vec4<i32>,    //  16  [cell] Columns of each layer.
  rows : vec4<i32>,       //  32  [cell] Rows of each layer.
  first_row : vec4<i32>,  //  48  [texel] Row of the buffer where each layer begins.
  shortest : u32,         //  64  [ms] Shortest cycle.
  span : u32,             //  68  [ms] Longest cycle less shortest.
  largest : f32,          //  72  [cell] Radius of a layer's largest drop.
  impact : f32,           //  76  [1] Share of the cycle in which a drop spreads.
}
@group(0) @binding(0) var<uniform> u: CellsUniforms;

@fragment
fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {
  let texel = vec2i(place.xy);
  var layer = -1;
  for (var l = 0; l < 4; l++) {
    let line = texel.y - u.first_row[l];
    if (line >= 0 && line < u.rows[l] && texel.x < u.columns[l]) { layer = l; }
  }
  if (layer < 0) { return vec4f(0.0); }
  let cell = u32(texel.x) | (u32(texel.y - u.first_row[layer]) << 16u);
  let own = random_block(62u, cell, u32(layer));
  let span = u.shortest + (((own.x >> 16u) * u.span) >> 16u);
  let start = ((own.y >> 16u) * span) >> 16u;
  let time = u.tick + start;
  let cycle = time / span;
  let drop = random_block(63u, cell, cycle * 4u + u32(layer));
  if ((drop.x >> 16u) >= u.keep) { return vec4f(0.0); }
  let share = vec4f(vec4u(drop.yzw >> vec3u(16u), ((time % span) << 16u) / span)) / 65536.0;
  let reach = u.largest / sqrt(1.0 + 3.0 * share.x);
  let grown = min(share.w / u.impact, (1.0 - share.w) / (1.0 - u.impact));
  let radius = reach * sqrt(max(grown, 0.0));
  let centre = 0.5 + (share.yz - 0.5) * (1.0 - 2.0 * reach);
  return vec4f(centre, radius, share.w);
}
