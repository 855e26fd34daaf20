// What the cells of the corrected window hold: whole numbers, from (seed, layer, cell, cycle) alone.
#pragma once

#include "rainref/image.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// A cell at a time, in whole numbers of 16 bits: so every GPU draws the same.
struct CellState {
  bool holds_drop;
  std::uint32_t cycle;       ///< which one this is
  std::uint32_t phase;       ///< of 65536: how far it has come
  std::uint32_t size, x, y;  ///< of 65536
};
/// Of the texel (column, row) of the buffer of cells; none where no layer has a cell there.
/// A cell has a cycle of its own length, and starts within it; each cycle draws place and size anew.
CellState cell_state(const CellsUniforms& uniforms, int column, int row);

/// The pass, for rows [begin, end) of the buffer: rgba32f, centre x, y, radius [cell]; phase. The same on every target: one
/// number at a time.
void cells_rows(const CellsUniforms& uniforms, Image& cells, int begin, int end);

}  // namespace rainref::screen_drops
