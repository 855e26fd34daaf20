#include "screen_drops/cells.h"

#include "random/counter.h"
#include "screen_drops/plain.h"

namespace rainref::screen_drops {

CellLine::CellLine(const CellsUniforms& uniforms, int row) : u_(uniforms) {
  for (int l = 0; l < layers; ++l) {
    const std::int32_t line = row - u_.first_row[l];
    if (line < 0 || line >= u_.rows[l]) continue;
    layer_ = static_cast<std::uint32_t>(l);
    line_ = static_cast<std::uint32_t>(line) << 16;
    columns_ = u_.columns[l];
  }
}
CellState CellLine::at(int column) const {
  if (column >= columns_) return {};
  const std::uint64_t seed = u_.seed[0] | static_cast<std::uint64_t>(u_.seed[1]) << 32;
  const std::uint32_t cell = static_cast<std::uint32_t>(column) | line_;
  const random::Block own = random::block(seed, random::Purpose::screen_cell, cell, layer_);
  const std::uint32_t length = u_.shortest + ((own[0] >> 16) * u_.span >> 16), start = (own[1] >> 16) * length >> 16;
  const std::uint32_t time = u_.tick + start, cycle = time / length;
  const random::Block drop = random::block(seed, random::Purpose::screen_drop, cell, cycle * layers + layer_);
  return {(drop[0] >> 16) < u_.keep, cycle, (time % length << 16) / length, drop[1] >> 16, drop[2] >> 16, drop[3] >> 16};
}

void cells_rows(const CellsUniforms& u, Image& cells, int begin, int end) {
  using N = plain::Plain<float>;
  for (int y = begin; y < end; ++y) {
    const CellLine line(u, y);
    float* out = cells.row<float>(y);
    for (int x = 0; x < cells.width(); ++x, out += 4) {
      const CellState s = line.at(x);
      const auto share = [](std::uint32_t of_65536) { return N(static_cast<float>(of_65536) * 0x1p-16f); };
      const auto d = s.holds_drop ? scalar::cell_drop<N>(u, share(s.size), share(s.x), share(s.y), share(s.phase)) : scalar::CellDrop<N>{};
      out[0] = d.x.v;
      out[1] = d.y.v;
      out[2] = d.radius.v;
      out[3] = d.phase.v;
    }
  }
}

}  // namespace rainref::screen_drops
