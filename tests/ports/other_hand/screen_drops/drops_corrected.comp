// screen_drops.drops, corrected. The scene through drops on a window.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform DropsUniforms {
  vec4 cells_per_pixel;  //   0  [cell/pixel] Of each layer.
  vec4 offset_x;         //  16  [cell] Place of the picture's corner in each layer.
  vec4 offset_y;         //  32  [cell] Place of the picture's corner in each layer.
  vec4 pixels_per_cell;  //  48  [pixel/cell] Of each layer.
  vec4 level;            //  64  [1] Mip level at which each layer's drops see the scene.
  ivec4 first_row;       //  80  [texel] Row of cells where each layer begins.
  vec2 pixel;            //  96  [1] Extent of a pixel on the image plane at distance 1.
  vec2 half_size;        // 104  [1] Half the extent of the image plane at distance 1.
  vec2 scene_scale;      // 112  [1] Texture coordinates of the scene per unit of the image plane.
  float sine;            // 120  [1] Of the contact angle.
  float water_ior;       // 124  [1] Refractive index of water.
  float inner;           // 128  [1] Share of the background that the water's surface mirrors.
  int has_flow;          // 132  [1] 1: height counts.
  vec2 flow_slope;       // 136  [1/mm] Slope per difference of heights two texels apart.
  vec2 flow_pixel;       // 144  [1] 1 over the picture's columns and rows.
  float visible_from;    // 152  [mm] Height at which flowing water begins to show.
  float visible_to;      // 156  [mm] Height from which it shows fully.
  float flow_level;      // 160  [1] Mip level at which flowing water sees the scene.
  float padding_0;       // 164  padding
  vec2 flow_texel;       // 168  [1] 1 over the columns and rows of height.
} given;
layout(binding = 1) uniform sampler2D background;
layout(binding = 2) uniform sampler2D scene;
layout(binding = 3) uniform sampler2D cells;
layout(binding = 4) uniform sampler2D height;
layout(binding = 5) uniform writeonly image2D water;
layout(binding = 6) uniform writeonly image2D colour;

float ramp(float low, float high, float x) {
  float t = clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
// The share of light that a surface of index n throws back, c the cosine on the side of the air.
float thrown_back(float c, float n) {
  float t = sqrt(max(1.0 - (1.0 - c * c) * (1.0 / (n * n)), 0.0));
  float first = (n * c - t) / (n * c + t);
  float second = (c - n * t) / (c + n * t);
  return 0.5 * (first * first + second * second);
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec2 centre = vec2(here) + 0.5;

  vec4 water_here = vec4(0.0);  // slope x and y, cover, level
  int layer = 4;
  while (layer > 0) {
    --layer;
    vec2 cell = centre * given.cells_per_pixel[layer] + vec2(given.offset_x[layer], given.offset_y[layer]);
    ivec2 index = ivec2(floor(cell));
    vec3 disc = texelFetch(cells, ivec2(index.x, index.y + int(given.first_row[layer])), 0).xyz;
    vec2 away = (cell - floor(cell)) - disc.xy;
    float scale = given.pixels_per_cell[layer];
    float cover = clamp((disc.z - length(away)) * scale + 0.5, 0.0, 1.0);
    cover *= min(2.0 * disc.z * scale, 1.0);
    vec2 slope = away * given.sine / max(disc.z, 1e-3);
    water_here = mix(water_here, vec4(slope, 1.0, given.level[layer]), cover);
  }

  if (given.has_flow != 0) {
    vec2 place = centre * given.flow_pixel;
    vec2 east = vec2(given.flow_texel.x, 0.0);
    vec2 north = vec2(0.0, given.flow_texel.y);
    float left = textureLod(height, place - east, 0.0).r;
    float right = textureLod(height, place + east, 0.0).r;
    float down = textureLod(height, place - north, 0.0).r;
    float up = textureLod(height, place + north, 0.0).r;
    float mean = 0.25 * (left + right + down + up);
    float cover = ramp(given.visible_from, given.visible_to, mean);
    vec2 g = vec2(right - left, up - down) * given.flow_slope;
    vec2 slope = -g / sqrt(1.0 + g.x * g.x + g.y * g.y);
    water_here = mix(water_here, vec4(slope, 1.0, given.flow_level), cover);
  }

  float cover = water_here.z;
  vec3 light = texelFetch(background, here, 0).rgb;
  if (cover > 0.0) {
    vec2 tilt = water_here.xy;
    float rest = max(1.0 - tilt.x * tilt.x - tilt.y * tilt.y, 0.04);
    vec3 outside = normalize(vec3(tilt, sqrt(rest)));
    vec3 view = normalize(vec3(centre * given.pixel - given.half_size, 1.0));
    vec3 inside = refract(view, vec3(0.0, 0.0, -1.0), 1.0 / given.water_ior);
    vec3 leaving = refract(inside, -outside, given.water_ior);
    float lost = thrown_back(clamp(dot(leaving, outside), 0.0, 1.0), given.water_ior);
    vec2 target = 0.5 + leaving.xy / max(leaving.z, 0.05) * given.scene_scale;
    vec3 seen = textureLod(scene, target, water_here.w).rgb;
    vec3 through = mix(seen, given.inner * light, lost);
    light = mix(light, through, cover);
  }
  imageStore(water, here, vec4(cover, 0.0, 0.0, 0.0));
  imageStore(colour, here, vec4(light, 1.0));
}
