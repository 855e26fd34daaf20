// Contents of the cells of the corrected window: integers that depend on (seed, layer, cell, cycle) alone.
#pragma once

#include <span>

#include "rainref/image.h"
#include "random/words.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// A cell at one time, in 16-bit integers, so that every GPU draws the same.
struct CellState {
  bool holds_drop;
  std::uint32_t cycle;       ///< number of the cycle
  std::uint32_t phase;       ///< of 65536: elapsed share of the cycle
  std::uint32_t size, x, y;  ///< of 65536
};
/// The draws of a cell: its clock, which never changes, and the contents of its cycle. Length 0: not drawn yet.
struct DrawnCell {
  std::uint32_t length = 0, start = 0;  ///< of the clock [tick]
  std::uint32_t begin = 0;              ///< time at which the cycle began
  CellState cycle{};                    ///< phase 0
};
/// A row of the buffer of cells. A cell has a cycle of its own length and offset; each cycle draws a new position and size. W:
/// random::Words or PerturbedWords.
template <class W = random::Words>
class CellLine {
 public:
  CellLine(const CellsUniforms& uniforms, int row);
  /// The state of the texel in this column; none if the row's layer has no cell there.
  CellState at(int column) const;
  /// The same, reusing the draws of this texel's cell in an earlier frame; they are renewed if the cycle is over.
  CellState at(int column, DrawnCell& drawn) const;

 private:
  void draw_clock(int column, DrawnCell& drawn) const;
  void draw_cycle(int column, std::uint32_t time, DrawnCell& drawn) const;

  const CellsUniforms& u_;
  std::uint32_t layer_ = 0, line_ = 0;
  std::int32_t columns_ = 0;
};

/// The pass, for rows [begin, end) of the buffer: rgba32f, centre x, y, radius [cell]; phase. It is the same on every target, because it
/// computes one number at a time. drawn: for each texel, from the last frame or empty; only tick may change between frames.
void cells_rows(const CellsUniforms& uniforms, std::span<DrawnCell> drawn, Image& cells, int begin, int end);

}  // namespace rainref::screen_drops
