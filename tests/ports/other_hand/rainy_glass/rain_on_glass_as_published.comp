// rainy_glass.rain_on_glass, as-published. The scene behind glass with two maps of water.
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
layout(binding = 6) uniform sampler2D probe;
layout(binding = 7) uniform writeonly image2D colour;

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
// Normals of the rivulets that have flowed for a share of their period.
vec2 streaks(vec2 tile, vec2 flow, float share) { return tiled(rivulets, tile + flow * (given.flow_strength * share)).rg; }

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(here, imageSize(colour)))) return;
  vec4 facing = texelFetch(orientation, here, 0);
  if (facing.w <= 0.5) {
    imageStore(colour, here, vec4(texelFetch(scene, here, 0).rgb, 1.0));
    return;
  }
  vec2 glass = texelFetch(surface, here, 0).xy;

  vec4 drop = tiled(raindrops, glass * given.drop_tiles);
  float timer = fract(given.time * given.drop_rate + drop.b);
  float eroded = drop.a - (1.0 - given.rain_amount) - timer;
  float mask = eroded > 0.0 ? 1.0 : 0.0;

  vec2 tile = glass * given.rivulet_tiles;
  vec2 flow = tiled(rivulets, tile).ba;
  float first = fract(given.time * given.flow_rate);
  float second = fract(given.time * given.flow_rate + 0.5);
  float swap = abs(1.0 - 2.0 * first);
  vec2 rivulet = mix(streaks(tile, flow, first), streaks(tile, flow, second), swap);

  float steep = 1.0 - abs(facing.y);
  vec2 slope = mask * drop.rg + steep * rivulet;
  vec2 shift = given.distortion * (2.0 * slope - 1.0);
  vec2 place = (vec2(here) + 0.5) * given.pixel + shift;

  vec3 seen;
  if (given.use_probe != 0) {
    vec2 screen = (2.0 * place - 1.0) * vec2(given.half_width, given.half_height);
    vec3 way = given.forward + screen.x * given.right + screen.y * given.up;
    float longitude = atan(way.z, way.x) / (2.0 * PI);
    float latitude = atan(way.y, length(way.xz)) / PI;
    seen = textureLod(probe, vec2(longitude, latitude) + 0.5, given.probe_level).rgb;
  } else {
    seen = textureLod(scene, place, 0.0).rgb;
  }
  imageStore(colour, here, vec4(seen, 1.0));
}
