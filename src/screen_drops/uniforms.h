// Uniform blocks of the passes of screen_drops. Sizes are multiples of 16 bytes, no member crosses a 16-byte row, and every gap is a named
// padding member, so the bytes are valid in every GPU language.
#pragma once

#include <cstdint>

namespace rainref::screen_drops {

constexpr int layers = 4;  ///< corrected: grids of cells, 0 is the coarsest
constexpr int most_published_layers = 16;
/// As published: with a smaller threshold, mix(.2, 2, t - .5) reaches 0 at t = .389, and the normal of a drop may have no length.
constexpr double least_threshold = 0.4;

/// A position where the background reads the scene, relative to the pixel's own, in texture coordinates.
struct Tap {
  float x, y, padding0, padding1;
};

struct BackgroundUniforms {
  float resolution[2], level, weight;
  float scale[2], offset[2];
  std::int32_t tap_count, padding0, padding1, padding2;
};

/// drops, as published.
struct PublishedDropsUniforms {
  float resolution[2], time, grid;
  float keep, refraction;
  std::int32_t printed_misprint, noise_nearest;
  std::int32_t layers;
  float water_step, cell_angle, noise_middle;
  float displacement, keep_from, threshold;
  std::int32_t printed_normal;
  float level;
  std::int32_t gradient_level, padding0, padding1;
};

/// cells: integers decide, floats follow.
struct CellsUniforms {
  std::uint32_t seed[2], tick, keep;
  std::int32_t columns[4];
  std::int32_t rows[4];
  std::int32_t first_row[4];
  std::uint32_t shortest, span;
  float largest, impact;
};

/// drops, corrected.
struct DropsUniforms {
  float cells_per_pixel[4];
  float offset_x[4];
  float offset_y[4];
  float pixels_per_cell[4];
  float level[4];
  std::int32_t first_row[4];
  float pixel[2], half_size[2];
  float scene_scale[2], sine, water_ior;
  float inner;
  std::int32_t has_flow;
  float flow_slope[2];
  float flow_pixel[2], visible_from, visible_to;
  float flow_level, padding0, flow_texel[2];
};

/// The water that drops must evaluate: bits 0 to 3 the layers, bit 4 flowing water. Left-out water must be invisible.
using Wanted = std::uint32_t;
constexpr Wanted wanted_flow = 1u << layers, wanted_all = 2 * wanted_flow - 1;

static_assert(sizeof(Tap) == 16 && sizeof(BackgroundUniforms) == 48 && sizeof(PublishedDropsUniforms) == 80 && sizeof(CellsUniforms) == 80);
static_assert(sizeof(DropsUniforms) == 176);

}  // namespace rainref::screen_drops
