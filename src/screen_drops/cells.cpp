#include "screen_drops/cells.h"

#include "random/draws.h"
#include "screen_drops/scalar.h"

namespace rainref::screen_drops {

template <class W>
CellLine<W>::CellLine(const CellsUniforms& uniforms, int row) : u_(uniforms) {
  for (int l = 0; l < layers; ++l) {
    const std::int32_t line = row - u_.first_row[l];
    if (line < 0 || line >= u_.rows[l]) continue;
    layer_ = static_cast<std::uint32_t>(l);
    line_ = W::counted_from(u_.first_row[l], row) << 16;
    columns_ = u_.columns[l];
  }
}
template <class W>
void CellLine<W>::draw_clock(int column, DrawnCell& drawn) const {
  const std::uint64_t seed = u_.seed[0] | static_cast<std::uint64_t>(u_.seed[1]) << 32;
  const random::Block own = W::block(seed, random::Purpose::screen_cell, static_cast<std::uint32_t>(column) | line_, layer_);
  drawn.length = u_.shortest + ((own[0] >> 16) * u_.span >> 16);
  drawn.start = (own[1] >> 16) * drawn.length >> 16;
}
template <class W>
void CellLine<W>::draw_cycle(int column, std::uint32_t time, DrawnCell& drawn) const {
  const std::uint64_t seed = u_.seed[0] | static_cast<std::uint64_t>(u_.seed[1]) << 32;
  const std::uint32_t cycle = time / drawn.length;
  const auto drop = W::block(seed, random::Purpose::screen_drop, static_cast<std::uint32_t>(column) | line_, cycle * layers + layer_);
  drawn.begin = cycle * drawn.length;
  drawn.cycle = {(drop[0] >> 16) < u_.keep, cycle, 0, drop[1] >> 16, drop[2] >> 16, drop[3] >> 16};
}
template <class W>
CellState CellLine<W>::at(int column, DrawnCell& drawn) const {
  if (column >= columns_) return {};
  const bool is_new = drawn.length == 0;
  if (is_new) draw_clock(column, drawn);
  // Time is modulo 2^32: it may lie before the drawn cycle.
  const std::uint32_t time = u_.tick + drawn.start;
  if (is_new || time < drawn.begin || time - drawn.begin >= drawn.length) draw_cycle(column, time, drawn);
  CellState s = drawn.cycle;
  s.phase = ((time - drawn.begin) << 16) / drawn.length;
  return s;
}
template <class W>
CellState CellLine<W>::at(int column) const {
  DrawnCell drawn;
  return at(column, drawn);
}
template class CellLine<random::Words>;
template class CellLine<random::PerturbedWords>;

void cells_rows(const CellsUniforms& u, std::span<DrawnCell> drawn, Image& cells, int begin, int end) {
  using N = scalar::Scalar<float>;
  for (int y = begin; y < end; ++y) {
    const CellLine line(u, y);
    DrawnCell* cell = drawn.data() + static_cast<std::ptrdiff_t>(y) * cells.width();
    float* out = cells.row<float>(y);
    for (int x = 0; x < cells.width(); ++x) {
      scalar::give_cell<N>(u, line.at(x, cell[x]), [&](const scalar::Vec3<N>& drop, N phase) {
        for (const N n : {drop.x, drop.y, drop.z, phase}) *out++ = n.v;
      });
    }
  }
}

}  // namespace rainref::screen_drops
