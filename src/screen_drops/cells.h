// What the cells of the corrected window hold: whole numbers, from (seed, layer, cell, cycle) alone.
#pragma once

#include <span>

#include "rainref/image.h"
#include "random/words.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// A cell at a time, in whole numbers of 16 bits: so every GPU draws the same.
struct CellState {
  bool holds_drop;
  std::uint32_t cycle;       ///< which one this is
  std::uint32_t phase;       ///< of 65536: how far it has come
  std::uint32_t size, x, y;  ///< of 65536
};
/// What a cell has drawn: its own clock, for good, and what its cycle holds. Length 0: nothing yet.
struct DrawnCell {
  std::uint32_t length = 0, start = 0;  ///< of the clock [tick]
  std::uint32_t begin = 0;              ///< time at which the cycle began
  CellState cycle{};                    ///< phase 0
};
/// A row of the buffer of cells. A cell has a cycle of its own length, and starts within it; each cycle draws place and size
/// anew. W: random::Words or PerturbedWords.
template <class W = random::Words>
class CellLine {
 public:
  CellLine(const CellsUniforms& uniforms, int row);
  /// Of the texel in this column; none where the row's layer has no cell.
  CellState at(int column) const;
  /// The same from what this texel's cell drew in an earlier frame of a window, which is drawn anew where its cycle is over.
  CellState at(int column, DrawnCell& drawn) const;

 private:
  void draw_clock(int column, DrawnCell& drawn) const;
  void draw_cycle(int column, std::uint32_t time, DrawnCell& drawn) const;

  const CellsUniforms& u_;
  std::uint32_t layer_ = 0, line_ = 0;
  std::int32_t columns_ = 0;
};

/// The pass, for rows [begin, end) of the buffer: rgba32f, centre x, y, radius [cell]; phase. The same on every target: one
/// number at a time. drawn: of each texel, from the frame before or empty; only tick may change from frame to frame.
void cells_rows(const CellsUniforms& uniforms, std::span<DrawnCell> drawn, Image& cells, int begin, int end);

}  // namespace rainref::screen_drops
