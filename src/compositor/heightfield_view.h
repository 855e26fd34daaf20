// A heightfield as plain numbers and pointers, for its kernels.
#pragma once

#include <cstdint>

#include "compositor/packet.h"

namespace rainref::compositor {

/// A walk prefetches cells before it knows whether it needs them, at most this many minus one beyond the field.
inline constexpr int cells_ahead = 3;
/// Side of a block of cells; a ray high above the next block skips it at once.
inline constexpr int block_cells = 8;

struct HeightfieldView {
  const float* heights;  ///< of the vertices, rows of columns + 1
  const float* pairs;    ///< each vertex's height and that of the next row, except for the last row; so the corners of a cell are adjacent
  const float* highest;  ///< maximum of the four corners of each cell, rows of columns + 1; readable cells_ahead - 1 rows and cells outside
  const float* nearby;   ///< the highest vertex of a block and its eight neighbours, rows of blocks_across
  int blocks_across;
  double columns;
  int rows;
  double origin[3];
  bool is_level;         ///< to_grid depends only on x in its first row, on z in its second, and on y in its third
  double to_grid[3][3];  ///< rows: cells along u, cells along v, and height of a world direction
};

/// A tile for the walk in floats; heightfield_float_walk-inl.h shows that these bounds suffice. Heights are relative to `middle`, cells to
/// the tile's first.
struct FloatTile {
  float columns, rows;
  float middle;
  float low, high;              ///< of the tile, widened by the float error outside it
  float beside;                 ///< [cells] a ray may pass the tile at this distance and still be tested
  float longest;                ///< [cells] largest distance of two points of the tile along an axis
  float away, tall;             ///< a ray whose walk would begin this far away (cells, height),
  float far_beside, far_above;  ///< or whose origin is, is left to doubles
  float doubt, doubt_for_cell;  ///< error of a height above the sheet: in total, and for each cell that the ray passes
  float steepest_twice;
  int first;                         ///< number of vertex (x0, y0)
  int first_block;                   ///< index of the block of cell (x0, y0)
  float into_block_x, into_block_y;  ///< position of that cell in the block
  float last_block_x, last_block_y;  ///< of the tile's last block, relative to the first
};

/// Cells [x0, x1) x [y0, y1), and the range of their vertices' heights.
struct HeightfieldTile {
  double x0, x1, y0, y1;
  double low = 0, high = 0;
  double steepest = 0;   ///< largest difference of two neighbouring vertices along a row or a column
  double margin = 0;     ///< of heights, wherever cells are skipped: far above the rounding error of a ray's height
  double roundings = 0;  ///< rounding error of a ray's height above the sheet in doubles, for the origins that floats handle
  FloatTile floats{};
};

/// Sets `margin`, `roundings` and `floats` of a tile with known heights. cell_height: the longer side of a cell, in units of height.
void set_margins(const HeightfieldView& field, double cell_height, HeightfieldTile& tile);

/// Intersects the tile with the lanes' rays; see Surface::meet_packet. Parts are 2 cell + (1 on the side of the fourth vertex).
std::uint32_t meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, std::uint32_t lanes, Packet& packet);
/// The same for one ray, by the scalar evaluation.
void meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, const Ray& ray, Hit& first);

/// Writes `highest` and `pairs` of the tile's cells (rows of columns + 1 cells and pairs), and its low, high and steepest. x0, x1, y0 and
/// y1 must be set.
void summarize_tile(const float* heights, int columns, float* highest, float* pairs, HeightfieldTile& tile);
/// blocks[b]: the maximum of up to block_cells rows of cells, in the columns of block b. 1 <= rows, 1 <= columns.
void summarize_blocks(const float* highest, int columns, int rows, float* blocks);

}  // namespace rainref::compositor
