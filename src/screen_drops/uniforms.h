// What the passes of screen_drops take besides images. Sizes are multiples of 16 bytes, nothing straddles a 16-byte row, and
// every gap is a named padding member, so the bytes serve every GPU language.
#pragma once

#include <cstdint>

namespace rainref::screen_drops {

constexpr int layers = 4;  ///< corrected: grids of cells, 0 is the coarsest
constexpr int most_published_layers = 16;
/// As published: with less, mix(.2, 2, t - .5) reaches 0 at t = .389, and the normal of a drop may have no length.
constexpr double least_threshold = 0.4;

/// A place where the background looks at the scene, from the pixel's own, in texture coordinates.
struct Tap {
  float x, y;
  float padding0, padding1;
};

struct BackgroundUniforms {
  float resolution[2];  ///< as-published: columns and rows of the picture
  float level;          ///< mip level of the lookups
  float weight;         ///< corrected: of a tap
  float scale[2];       ///< corrected: pixel centre to texture coordinates of the scene
  float offset[2];
  std::int32_t tap_count;
  std::int32_t padding0, padding1, padding2;
};

/// drops, as published.
struct PublishedDropsUniforms {
  float resolution[2];            ///< columns and rows of the picture
  float time;                     ///< n / fps, rounded once [s]
  float grid;                     ///< cells of layer 1 in a pixel
  float keep;                     ///< times keep_from - layer: the noise below which a cell holds a drop
  float refraction;               ///< pictures per unit of the normal
  std::int32_t printed_misprint;  ///< 1: the displacement as the report prints it
  std::int32_t noise_nearest;     ///< 1: noise is looked up unfiltered
  std::int32_t layers;            ///< grids of cells
  float water_step;               ///< 1 / layers
  float cell_angle;               ///< of the sine over a cell [rad]
  float noise_middle;             ///< noise that displaces nothing
  float displacement;             ///< of the grid per unit of noise [rad]
  float keep_from;                ///< layer from which on no cell holds a drop
  float threshold;                ///< sum of the sines above which a drop is
  std::int32_t printed_normal;    ///< 1: the normal as the report prints it, of the cosine of a sine
};

/// cells: whole numbers decide, floats follow.
struct CellsUniforms {
  std::uint32_t seed[2];    ///< low word, high word
  std::uint32_t tick;       ///< the frame's time, modulo 2^32 [ms]
  std::uint32_t keep;       ///< of 65536 cells hold a drop
  std::int32_t columns[4];  ///< cells of each layer
  std::int32_t rows[4];
  std::int32_t first_row[4];  ///< of the buffer, where the layer begins
  std::uint32_t shortest;     ///< cycle [ms]
  std::uint32_t span;         ///< longest cycle less shortest [ms]
  float largest;              ///< radius of a layer's largest drop [cell]
  float impact;               ///< share of the cycle in which a drop spreads
};

/// drops, corrected.
struct DropsUniforms {
  float cells_per_pixel[4];  ///< of each layer
  float offset_x[4];         ///< place of the picture's corner in the layer [cell]
  float offset_y[4];
  float pixels_per_cell[4];
  float level[4];             ///< mip level at which the layer's drops see the scene
  std::int32_t first_row[4];  ///< as CellsUniforms
  float pixel[2];             ///< extent of a pixel on the image plane at distance 1
  float half_size[2];         ///< half the extent of the image plane
  float scene_scale[2];       ///< texture coordinates of the scene per unit of the image plane
  float sine;                 ///< of the contact angle
  float water_ior;
  float inner;                     ///< share of the background that the water's surface mirrors
  std::int32_t has_flow;           ///< 1: height counts
  float flow_slope[2];             ///< slope per difference of heights two texels apart [1/mm]
  float flow_pixel[2];             ///< 1 / columns and rows of the picture
  float visible_from, visible_to;  ///< height at which flowing water begins to show, and shows fully [mm]
  float flow_level;                ///< mip level at which flowing water sees the scene
  float padding0;
  float flow_texel[2];  ///< 1 / columns and rows of height
};

/// The water that drops has to ask for: bits 0 to 3 the layers, bit 4 what flows. What is left out must show nothing.
using Wanted = std::uint32_t;
constexpr Wanted wanted_flow = 1u << layers, wanted_all = 2 * wanted_flow - 1;

static_assert(sizeof(Tap) == 16 && sizeof(BackgroundUniforms) == 48 && sizeof(PublishedDropsUniforms) == 64 && sizeof(CellsUniforms) == 80);
static_assert(sizeof(DropsUniforms) == 176);

}  // namespace rainref::screen_drops
