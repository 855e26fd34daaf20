// rainy_glass.bake_rivulets, as-published and corrected. The rivulet map: normals of rivulets, and their flow. Once, before frame 0.
#version 450
#extension GL_GOOGLE_include_directive : enable
#include "port.glsl"

layout(std140, binding = 0) uniform BakeRivuletsUniforms {
  vec2 inverse_size;   //   0  [1] 1 over the map's columns and rows.
  int trail_count;     //   8  [1] Rivulets in the list.
  float normal_scale;  //  12  [1] Slope of the water over the gradient of the height.
  float neutral;       //  16  [1] Stored value of 0.
  float span;          //  20  [1] Stored value of 1 less neutral.
  int flow_cells;      //  24  [1] Cells of the flow's coarser octave along a side.
  float flow_gain;     //  28  [1] Factor of the noise before it is held in [-1, 1].
} u;
struct Trail {
  float x;               //   0  [1] Centre of the head, in tiles.
  float y;               //   4  [1] Centre of the head.
  float half_width;      //   8  [1] Of the head.
  float inverse_length;  //  12  [1] 1 over the length of the tail.
  float height;          //  16  [1] Of the head.
  float wiggle;          //  20  [1] Amplitude of the winding.
  float wiggle_rate;     //  24  [1] Turns of the winding in a tile.
  float wiggle_phase;    //  28  [1] At the head, in turns.
};
layout(std430, binding = 1) readonly buffer TrailBuffer { Trail trails[]; };
layout(binding = 2) uniform sampler2D lattice;
layout(binding = 3) uniform writeonly image2D rivulets;
#include "bake.glsl"
const float TWO_PI = 6.28318530717959;

// Gradient noise for the flow across (xy) and along (zw) the glass.
vec2 gradient_noise(vec2 place, int cells) {
  vec2 x = place * float(cells), whole = floor(x), f = x - whole;
  ivec2 low = ivec2(whole), high = (low + 1) % cells;
  vec4 a = texelFetch(lattice, low, 0), b = texelFetch(lattice, ivec2(high.x, low.y), 0);
  vec4 c = texelFetch(lattice, ivec2(low.x, high.y), 0), d = texelFetch(lattice, high, 0);
  vec2 fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  vec2 na = vec2(dot(a.xy, f), dot(a.zw, f)), nb = vec2(dot(b.xy, f - vec2(1, 0)), dot(b.zw, f - vec2(1, 0)));
  vec2 nc = vec2(dot(c.xy, f - vec2(0, 1)), dot(c.zw, f - vec2(0, 1))), nd = vec2(dot(d.xy, f - vec2(1, 1)), dot(d.zw, f - vec2(1, 1)));
  return mix(mix(na, nb, fade.x), mix(nc, nd, fade.x), fade.y);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (outside(texel, imageSize(rivulets))) return;
  vec2 here = texel_centre(texel), gradient = vec2(0.0);
  float height = 0.0;
  for (int k = 0; k < u.trail_count; ++k) {
    Trail t = trails[k];
    float dy = fract(here.y - t.y + 0.125) - 0.125;
    float angle = TWO_PI * around(t.wiggle_rate * dy + t.wiggle_phase);
    float dx = around(here.x - t.x) - t.wiggle * sin(angle);
    float inverse_sq = 1.0 / (t.half_width * t.half_width);
    bool tail = dy >= 0.0;
    float along = tail ? dy * t.inverse_length : dy * dy * inverse_sq;
    float h = t.height * (1.0 - along - dx * dx * inverse_sq);
    if (h > height) {
      height = h;
      float across = -2.0 * t.height * inverse_sq * dx;
      float lengthwise = tail ? -t.height * t.inverse_length : -2.0 * t.height * inverse_sq * dy;
      gradient = vec2(across, lengthwise - across * TWO_PI * t.wiggle * t.wiggle_rate * cos(angle));
    }
  }
  vec2 noise = gradient_noise(here, u.flow_cells) + 0.5 * gradient_noise(here, 2 * u.flow_cells);
  vec2 flow = u.neutral + u.span * clamp(u.flow_gain * noise, -1.0, 1.0);
  imageStore(rivulets, texel, vec4(stored_normal(gradient), flow));
}
