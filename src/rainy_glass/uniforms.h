// What the passes of rainy_glass take besides images: uniform blocks and the records of the bakes. Sizes are multiples of
// 16 bytes, nothing straddles a 16-byte row, and every gap is a named padding member, so the bytes serve every GPU language.
#pragma once

#include <cstdint>

namespace rainref::rainy_glass {

/// A droplet of the raindrop map. Lengths are in tiles. q = (m00 dx + m01 dy, m01 dx + m11 dy) is 1 long at its rim, which
/// lies within `radius` of its centre.
struct Droplet {
  float x, y;  ///< centre: multiples of 2^-16, so that differences to texel centres of a power-of-two map are exact
  float radius;
  float height;         ///< at the centre, of 1: proportional to the radius
  float m00, m01, m11;  ///< symmetric [1/tile]
  float offset;         ///< of its timer, in [0, 1)
};

/// A rivulet: a head with a tail above it that winds. Lengths are in tiles.
struct Trail {
  float x, y;            ///< centre of the head; multiples of 2^-16
  float half_width;      ///< of the head
  float inverse_length;  ///< of the tail; the tail is at most 0.8 long
  float height;          ///< of the head, of 1
  float wiggle;          ///< amplitude
  float wiggle_rate;     ///< [turns/tile]
  float wiggle_phase;    ///< [turns]
};

struct BakeRaindropsUniforms {
  float inverse_size[2];  ///< 1 / columns and rows of the map
  std::int32_t droplet_count;
  float normal_scale;   ///< slope of the water = normal_scale x gradient of the height
  float neutral, span;  ///< stored normal = neutral + span n
  float padding0, padding1;
};
struct BakeRivuletsUniforms {
  float inverse_size[2];
  std::int32_t trail_count;
  float normal_scale;
  float neutral, span;
  std::int32_t flow_cells;  ///< cells of the coarser octave of the flow along a side
  float flow_gain;          ///< stored flow = neutral + span clamp(flow_gain noise, -1, 1)
};

struct RainOnGlassUniforms {
  float pixel[2];       ///< 1 / columns and rows of the picture
  float time;           ///< as-published: n / fps, rounded once [s]
  float rain_amount;    ///< 1: every droplet
  float drop_tiles;     ///< tiles of the raindrop map in a metre of glass [1/m]
  float rivulet_tiles;  ///< of the rivulet map [1/m]
  float drop_rate;      ///< as-published: cycles of a droplet in a second [1/s]
  float flow_rate;      ///< as-published: cycles of the flow in a second [1/s]
  float flow_strength;  ///< offset of a rivulet in a cycle at full flow [tiles]
  float distortion;     ///< as-published: pictures per unit of the summed channels
  std::int32_t use_probe;
  float probe_level;                     ///< mip level of the probe
  float drop_phase;                      ///< corrected: fraction of the droplets' cycle [1]
  float flow_phase;                      ///< corrected: fraction of the flow's cycle [1]
  float scroll;                          ///< corrected: way of the rivulets, fraction of a tile [1]
  float run_strength;                    ///< corrected: share of a cycle's way that the vertical flow holds back or adds [tiles]
  float drop_neutral, drop_scale;        ///< corrected: normal = (stored - neutral) scale
  float rivulet_neutral, rivulet_scale;  ///< corrected
  float sharpness;                       ///< corrected: 1 / height over which a droplet's rim turns visible
  float impact;                          ///< corrected: share of the cycle in which a droplet appears
  float bend;                            ///< corrected: refractive index of water - 1
  float rivulet_amount;                  ///< corrected: weight of the rivulets' slopes
  float rain_to[3];                      ///< corrected: n . rain_to is the share of the rain that glass of normal n meets
  float padding0;
  float right[3];    ///< camera axes in the world
  float half_width;  ///< of the image plane at distance 1
  float up[3];
  float half_height;
  float forward[3];
  float padding1;
};

static_assert(sizeof(Droplet) == 32 && sizeof(Trail) == 32 && sizeof(BakeRaindropsUniforms) == 32 && sizeof(BakeRivuletsUniforms) == 32);
static_assert(sizeof(RainOnGlassUniforms) == 160);

}  // namespace rainref::rainy_glass
