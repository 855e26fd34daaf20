// Pass cells, corrected: the drop that a cell holds now, converted to shares from the 16-bit integers of cells.h.
#ifndef RAINREF_FN
#ifndef RAINREF_SCREEN_DROPS_CELLS_PASS_H_
#define RAINREF_SCREEN_DROPS_CELLS_PASS_H_
#include <string>

#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "screen_drops/cells.h"

namespace rainref::screen_drops {

/// Without lanes: integers are drawn one cell at a time, and cells_rows keeps them between frames.
struct CellsPass : pass::Takes<CellsUniforms> {
  static constexpr pass::About about{"cells", "The drop that each cell of four grids holds now.", {}, {1}};
  static scene::UniformBlock uniforms() {
    return block(
        {member<&U::seed>("1", scene::any_word, "Low and high word of the seed."),
         member<&U::tick>("ms", scene::any_word, "The frame's time, modulo 2^32."),
         member<&U::keep>("1", {0, 65536}, "Of 65536 cells hold a drop."),
         member<&U::columns>("cell", {1, 65536}, "Columns of each layer."), member<&U::rows>("cell", {1, 65536}, "Rows of each layer."),
         member<&U::first_row>("texel", {0, 1 << 24}, "Row of the buffer where each layer begins.")
             .guarded("the first layer begins in row 0"),
         member<&U::shortest>("ms", {1, 65535}, "Shortest cycle."), member<&U::span>("ms", {0, 65535}, "Longest cycle less shortest."),
         member<&U::largest>("cell", scene::share, "Radius of a layer's largest drop."),
         member<&U::impact>("1", scene::share, "Share of the cycle in which a drop spreads.")});
  }
  template <class Bound>
  static std::string fault(const Bound& b) {
    return b.uniforms.shortest == 0 ? "shortest: expected a cycle of 1 ms or more, found 0" : "";
  }
  template <class B>
  struct Io {
    typename B::template Result<Format::rgba32f> cells =
        pass::Out{.name = "cells",
                  .sentence =
                      "Of a cell's drop: centre x, y and radius, in cells; how far its cycle has come. Radius 0: none. Layers above "
                      "each other, coarsest first.",
                  .unit = "cell, cell, cell, 1"};
  };
};

}  // namespace rainref::screen_drops
#endif
#else

/// In cells: centre, radius of the base; and the elapsed share of its cycle. Radius 0: no drop.
template <class N>
struct CellDrop {
  N x, y, radius, phase;
};
/// Largest radius R of this cycle. Its density is ~ R^-3 between largest / 2 and largest, which layers of half the size each continue. The
/// area of the base grows to pi R^2 in the impact's share of the cycle and then shrinks, both linearly in time. The whole cap stays inside
/// its cell.
template <class N>
RAINREF_FN CellDrop<N> cell_drop(const CellsUniforms& c, N size, N x, N y, N phase) {
  const N one(1.0f), half(0.5f);
  const N reach = N(c.largest) / sqrt(one + N(3.0f) * size);
  const N share = min(phase * uniform_quotient(1.0f, c.impact, N()), (one - phase) * uniform_quotient(1.0f, 1.0f - c.impact, N()));
  const N room = one - N(2.0f) * reach;
  return {half + (x - half) * room, half + (y - half) * room, reach * sqrt(guard<N>(max(share, N(0.0f)), "the share is nowhere negative")),
          phase};
}
/// The texel of a cell with these draws.
template <class N, class Result>
RAINREF_FN void give_cell(const CellsUniforms& u, const CellState& s, const Result& cells) {
  const auto share = [](std::uint32_t of_65536) { return N(static_cast<float>(of_65536) * 0x1p-16f); };
  const N none(0.0f);
  if (!s.holds_drop) return cells(Vec3<N>(none, none, none), none);
  const CellDrop<N> d = cell_drop<N>(u, share(s.size), share(s.x), share(s.y), share(s.phase));
  cells(Vec3<N>(d.x, d.y, d.radius), d.phase);
}
struct CellsPassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const CellsUniforms& u, const Io& io, int column, int row) {
    give_cell<N>(u, CellLine<typename random::WordsOf<N>::type>(u, row).at(column), io.cells);
  }
};
#endif
