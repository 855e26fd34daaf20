// rainy_glass.rain_on_glass, corrected. The scene behind glass with two maps of water.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;

layout(std140, binding = 0) uniform RainOnGlassUniforms {
  vec2 pixel;             //   0  [1] 1 over the picture's columns and rows.
  float time;             //   8  [s] as-published: frame number over frame rate, rounded once.
  float rain_amount;      //  12  [1] 1: every droplet shows.
  float drop_tiles;       //  16  [1/m] Tiles of the raindrop map in a metre.
  float rivulet_tiles;    //  20  [1/m] Tiles of the rivulet map in a metre.
  float drop_rate;        //  24  [1/s] as-published: cycles of a droplet in a second.
  float flow_rate;        //  28  [1/s] as-published: cycles of the flow in a second.
  float flow_strength;    //  32  [1] Tiles by which full flow moves a rivulet in a cycle; corrected: across.
  float distortion;       //  36  [1] as-published: pictures per unit of the summed channels.
  int use_probe;          //  40  [1] 1: the reflection probe, 0: the scene's picture.
  float probe_level;      //  44  [1] Mip level of the probe.
  float drop_phase;       //  48  [1] corrected: fraction of the droplets' cycle.
  float flow_phase;       //  52  [1] corrected: fraction of the flow's cycle.
  float scroll;           //  56  [1] corrected: way of the rivulets down the glass, fraction of a tile.
  float run_strength;     //  60  [1] corrected: tiles by which full flow moves a rivulet along the glass in a cycle.
  float drop_neutral;     //  64  [1] corrected: stored value of 0 in the raindrop map.
  float drop_scale;       //  68  [1] corrected: normal over stored value less neutral.
  float rivulet_neutral;  //  72  [1] corrected: stored value of 0 in the rivulet map.
  float rivulet_scale;    //  76  [1] corrected: as drop_scale.
  float sharpness;        //  80  [1] corrected: 1 over the height in which a rim turns visible.
  float impact;           //  84  [1] corrected: share of the cycle in which a droplet spreads.
  float bend;             //  88  [1] corrected: refractive index of water less 1.
  float rivulet_amount;   //  92  [1] corrected: weight of the rivulets' slopes.
  vec3 rain_to;           //  96  [1] corrected: its product with the normal is the share of the rain that the glass meets.
  float padding_0;        // 108  padding
  vec3 right;             // 112  [1] Unit vector to the right of the picture, world.
  float half_width;       // 124  [1] Half the width of the image plane at distance 1.
  vec3 up;                // 128  [1] Unit vector to the top of the picture.
  float half_height;      // 140  [1] Half the height of the image plane at distance 1.
  vec3 forward;           // 144  [1] Unit vector into the picture.
  float padding_1;        // 156  padding
} given;
layout(binding = 1) uniform sampler2D surface;
layout(binding = 2) uniform sampler2D orientation;
layout(binding = 3) uniform sampler2D raindrops;
layout(binding = 4) uniform sampler2D rivulets;
layout(binding = 5) uniform sampler2D scene;
layout(binding = 6) uniform sampler2D scene_depth;
layout(binding = 7) uniform sampler2D near_depth;
layout(binding = 8) uniform sampler2D probe;
layout(binding = 9) uniform writeonly image2D colour;

const float PI = 3.14159265359;

// A map at a place in tiles. Devices may blend 8-bit texels coarsely, so the four are blended here.
vec4 tiled(sampler2D map, vec2 tile) {
  ivec2 size = textureSize(map, 0);
  vec2 place = fract(tile) * vec2(size) - 0.5;
  vec2 low = floor(place);
  vec2 part = place - low;
  ivec2 near = (ivec2(low) + size) % size;
  ivec2 far = (near + 1) % size;
  vec4 below = mix(texelFetch(map, near, 0), texelFetch(map, ivec2(far.x, near.y), 0), part.x);
  vec4 above = mix(texelFetch(map, ivec2(near.x, far.y), 0), texelFetch(map, far, 0), part.x);
  return mix(below, above, part.y);
}
// Slope of the water from a map's red and green.
vec2 slope_of(vec2 stored, float neutral, float scale) {
  vec2 side = (stored - neutral) * scale;
  return -side / sqrt(max(1.0 - side.x * side.x - side.y * side.y, 0.04));
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec3 light = texelFetch(scene, here, 0).rgb;
  vec4 facing = texelFetch(orientation, here, 0);
  vec3 glass = texelFetch(surface, here, 0).xyz;
  vec3 n = facing.xyz;
  float behind = texelFetch(scene_depth, here, 0).r;

  // Droplets grow while the impact lasts, then dry.
  vec4 drop = tiled(raindrops, glass.xy * given.drop_tiles);
  float amount = given.rain_amount * clamp(dot(n, given.rain_to), 0.0, 1.0);
  float timer = fract(given.drop_phase + drop.b);
  float growing = 1.0 - timer * (1.0 / given.impact);
  float drying = (timer - given.impact) * (1.0 / (1.0 - given.impact));
  float left = drop.a - (1.0 - amount);
  float shown = clamp((left - max(growing, drying)) * given.sharpness, 0.0, 1.0);

  // Rivulets, two phases half a period apart.
  vec2 tile = glass.xy * given.rivulet_tiles;
  vec2 flow = (tiled(rivulets, tile).ba - given.rivulet_neutral) * given.rivulet_scale;
  flow *= vec2(given.flow_strength, given.run_strength);
  vec2 phase = fract(vec2(given.flow_phase, given.flow_phase + 0.5));
  float swap = abs(1.0 - 2.0 * phase.x);
  vec2 base = tile + vec2(0.0, given.scroll);
  vec2 early = tiled(rivulets, base + flow * (phase.x - 0.5)).rg;
  vec2 late = tiled(rivulets, base + flow * (phase.y - 0.5)).rg;
  vec2 stored = mix(early, late, swap);

  float steep = sqrt(n.x * n.x + n.z * n.z);
  vec2 slope = shown * slope_of(drop.rg, given.drop_neutral, given.drop_scale);
  slope += (given.rivulet_amount * steep) * slope_of(stored, given.rivulet_neutral, given.rivulet_scale);

  bool wet = dot(slope, slope) > 1e-8;
  if (facing.w > 0.5 && behind > glass.z && wet) {
    float k = 1.0 / max(steep, 0.05);
    vec3 a = vec3(n.z * k, 0.0, -n.x * k);
    vec3 b = vec3(n.y * a.z, n.z * a.x - n.x * a.z, -n.y * a.x);
    vec3 rise = slope.x * a + slope.y * b;
    vec2 prism = given.bend * (rise * mat2x3(given.right, given.up));
    vec2 centre = (vec2(here) + 0.5) * given.pixel;
    vec2 half_size = vec2(given.half_width, given.half_height);
    if (given.use_probe != 0) {
      vec2 screen = (2.0 * centre - 1.0) * half_size + prism;
      vec3 way = given.forward + screen.x * given.right + screen.y * given.up;
      vec2 place = vec2(atan(way.z, way.x) / (2.0 * PI), atan(way.y, length(way.xz)) / PI) + 0.5;
      light = textureLod(probe, place, given.probe_level).rgb;
    } else {
      float parallax = clamp(1.0 - glass.z / max(behind, 1e-3), 0.0, 1.0);
      vec2 place = centre + prism * parallax * (0.5 / half_size);
      float nearest = textureLod(near_depth, place, 0.0).r;
      if (nearest > glass.z) light = textureLod(scene, place, 0.0).rgb;
    }
  }
  imageStore(colour, here, vec4(light, 1.0));
}
