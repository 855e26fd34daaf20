// What both versions of rain_on_glass share.
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
  float scroll;           //  56  [1] Way of the rivulets down the glass, fraction of a tile.
  float run_strength;     //  60  [1] corrected: tiles by which full flow moves a rivulet along the glass in a cycle.
  float drop_neutral;     //  64  [1] corrected: stored value of 0 in the raindrop map.
  float drop_scale;       //  68  [1] corrected: normal over stored value less neutral.
  float rivulet_neutral;  //  72  [1] corrected: stored value of 0 in the rivulet map.
  float rivulet_scale;    //  76  [1] corrected: as drop_scale.
  float sharpness;        //  80  [1] corrected: 1 over the height in which a rim turns visible.
  float impact;           //  84  [1] corrected: share of the cycle in which a droplet spreads.
  float bend;             //  88  [1] corrected: refractive index of water less 1.
  float rivulet_amount;   //  92  [1] Weight of the rivulets.
  vec3 rain_to;           //  96  [1] corrected: its product with the normal is the share of the rain that the glass meets.
  float padding_0;        // 108  padding
  vec3 right;             // 112  [1] Unit vector to the right of the picture, world.
  float half_width;       // 124  [1] Half the width of the image plane at distance 1.
  vec3 up;                // 128  [1] Unit vector to the top of the picture.
  float half_height;      // 140  [1] Half the height of the image plane at distance 1.
  vec3 forward;           // 144  [1] Unit vector into the picture.
  float padding_1;        // 156  padding
  vec2 turn;              // 160  [1] as-published: cosine and sine of the turn of the raindrop map.
  vec2 rivulet_turn;      // 168  [1] as-published: the same of the rivulet map.
  vec2 flow_from;         // 176  [1] as-published: flow across and along that the stored value 0 stands for.
  vec2 flow_span;         // 184  [1] as-published: flow that 1 stands for, less flow_from.
  vec3 tint;              // 192  [1] as-published: factor of the radiance behind the glass.
  float fade_rate;        // 204  [1] as-published: 1 over the range of |n.y| in which rivulets fade.
  int remap_first;        // 208  [1] as-published: 1: channels are remapped to [-1, 1] before the mask, 0: their sum is.
  int signed_offset;      // 212  [1] as-published: 1: the timer takes 2 B - 1, 0: B.
  int squared_weight;     // 216  [1] as-published: 1: the second phase weighs the square of |1 - 2 p|, 0: that.
  float padding_2;        // 220  padding
} u;
layout(binding = 1) uniform sampler2D surface;
layout(binding = 2) uniform sampler2D orientation;
layout(binding = 3) uniform sampler2D raindrops;
layout(binding = 4) uniform sampler2D rivulets;
layout(binding = 5) uniform sampler2D scene;
layout(binding = 6) uniform sampler2D probe;

vec3 probe_at(vec2 plane) {
  vec3 d = u.forward + plane.x * u.right + plane.y * u.up;
  const float PI = 3.14159265358979;
  return textureLod(probe, vec2(0.5 + atan(d.z, d.x) / (2.0 * PI), 0.5 + atan(d.y, length(d.xz)) / PI), u.probe_level).rgb;
}
// First phase, second phase, weight of the second.
vec3 flow_phases(float phase) {
  float first = fract(phase), second = fract(phase + 0.5);
  return vec3(first, second, abs(1.0 - 2.0 * first));
}
