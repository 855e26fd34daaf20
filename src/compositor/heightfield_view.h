// A heightfield as its kernels see it: plain numbers and pointers.
#pragma once

#include <cstdint>

#include "compositor/packet.h"

namespace rainref::compositor {

/// A walk fetches what it may need before it knows: up to this many cells, less one, beyond the field.
inline constexpr int cells_ahead = 3;
/// Side of a block of cells: a ray high above the next ones passes them at once.
inline constexpr int block_cells = 8;

struct HeightfieldView {
  const float* heights;  ///< of the vertices, rows of columns + 1
  const float* pairs;    ///< each vertex's height and that of the next row's; but for the last row. Corners of a cell lie together.
  const float* highest;  ///< of the four corners of each cell, rows of columns + 1; readable cells_ahead - 1 rows and cells outside
  const float* nearby;   ///< of a block and the eight around it the highest vertex, rows of blocks_across
  int blocks_across;
  double columns;
  int rows;
  double origin[3];
  bool is_level;         ///< of the rows below the first has a number for x alone, the second for z, the third for y
  double to_grid[3][3];  ///< rows: of a direction in the world, its cells along u, its cells along v, its height
};

/// A tile as the walk in floats sees it; heightfield_float_walk-inl.h says why these numbers are enough. Heights count from
/// `middle`, cells from the tile's first.
struct FloatTile {
  float columns, rows;
  float middle;
  float low, high;              ///< of the tile, and all that floats may be wrong outside of it
  float beside;                 ///< [cells] by which a ray may pass the tile and yet be asked
  float longest;                ///< [cells] no two places of the tile are as far apart along an axis
  float away, tall;             ///< rays whose walk would begin this far off (cells, height),
  float far_beside, far_above;  ///< or whose origin is, are left to doubles
  float doubt, doubt_for_cell;  ///< of a height above the sheet: in all, and for each cell that the ray goes
  float steepest_twice;
  int first;                         ///< number of vertex (x0, y0)
  int first_block;                   ///< number of the block of cell (x0, y0)
  float into_block_x, into_block_y;  ///< where in it that cell lies
  float last_block_x, last_block_y;  ///< of the tile's last block, from the first
};

/// Cells [x0, x1) x [y0, y1), and what their vertices' heights lie between.
struct HeightfieldTile {
  double x0, x1, y0, y1;
  double low = 0, high = 0;
  double steepest = 0;   ///< difference of two neighbouring vertices along a row or a column
  double margin = 0;     ///< of heights, wherever cells are skipped: far above the rounding of a ray's height
  double roundings = 0;  ///< of a ray's height above the sheet in doubles, for the origins that floats are asked about
  FloatTile floats{};
};

/// Sets `margin`, `roundings` and `floats` of a tile of known heights. cell_height: the longer side of a cell, in units of height.
void set_margins(const HeightfieldView& field, double cell_height, HeightfieldTile& tile);

/// Meets the tile with the lanes' rays, as Surface::meet_packet says. Parts are 2 cell + (1 on the side of the fourth
/// vertex).
std::uint32_t meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet);
/// The same for one ray, by the scalar evaluation.
void meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, const Ray& ray, Hit& first);

/// Writes `highest` and `pairs` of the tile's cells (rows of columns + 1 cells and pairs), and its low, high and steepest.
/// bounds: x0, x1, y0, y1 given.
void summarize_tile(const float* heights, int columns, float* highest, float* pairs, HeightfieldTile& tile);
/// blocks[b]: the highest of up to block_cells rows of cells, in the columns of block b. bounds: 1 <= rows, 1 <= columns.
void summarize_blocks(const float* highest, int columns, int rows, float* blocks);

}  // namespace rainref::compositor
