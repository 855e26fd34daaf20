#include "screen_drops/cells.h"

#include "random/counter.h"
#include "screen_drops/plain.h"

namespace rainref::screen_drops {

CellState cell_state(const CellsUniforms& u, int column, int row) {
  for (int l = 0; l < layers; ++l) {
    const std::int32_t line = row - u.first_row[l];
    if (line < 0 || line >= u.rows[l] || column >= u.columns[l]) continue;
    const std::uint64_t seed = u.seed[0] | static_cast<std::uint64_t>(u.seed[1]) << 32;
    const auto cell = static_cast<std::uint32_t>(column) | static_cast<std::uint32_t>(line) << 16, layer = static_cast<std::uint32_t>(l);
    const random::Block own = random::block(seed, random::Purpose::screen_cell, cell, layer);
    const std::uint32_t length = u.shortest + ((own[0] >> 16) * u.span >> 16), start = (own[1] >> 16) * length >> 16;
    const std::uint32_t time = u.tick + start, cycle = time / length;
    const random::Block drop = random::block(seed, random::Purpose::screen_drop, cell, cycle * layers + layer);
    return {(drop[0] >> 16) < u.keep, cycle, (time % length << 16) / length, drop[1] >> 16, drop[2] >> 16, drop[3] >> 16};
  }
  return {};
}

void cells_rows(const CellsUniforms& u, Image& cells, int begin, int end) {
  using N = plain::Plain<float>;
  for (int y = begin; y < end; ++y) {
    float* out = cells.row<float>(y);
    for (int x = 0; x < cells.width(); ++x, out += 4) {
      const CellState s = cell_state(u, x, y);
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
