// A heightfield as its kernels see it: plain numbers and pointers.
#pragma once

#include <cstdint>

#include "compositor/packet.h"

namespace rainref::compositor {

/// A walk fetches what it may need before it knows: up to this many cells, less one, beyond the field.
inline constexpr int cells_ahead = 3;

struct HeightfieldView {
  const float* heights;  ///< of the vertices, rows of columns + 1
  const float* highest;  ///< of the four corners of each cell, rows of columns; readable cells_ahead - 1 rows and cells outside
  double columns;
  int rows;
  double origin[3];
  double to_grid[3][3];  ///< rows: of a direction in the world, its cells along u, its cells along v, its height
};

/// Cells [x0, x1) x [y0, y1), and what their vertices' heights lie between.
struct HeightfieldTile {
  double x0, x1, y0, y1, low, high;
  double margin;  ///< of heights, wherever cells are skipped: far above the rounding of a ray's height
};

/// Meets the tile with the lanes' rays, as Surface::meet_packet says. Parts are 2 cell + (1 on the side of the fourth
/// vertex).
std::uint32_t meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet);
/// The same for one ray, by the scalar evaluation.
void meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, const Ray& ray, Hit& first);

/// Writes `highest` of the tile, and its low and high. bounds: x0, x1, y0, y1 given.
void summarize_tile(const float* heights, int columns, float* highest, HeightfieldTile& tile);

}  // namespace rainref::compositor
