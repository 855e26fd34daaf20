// The bound that a pass is measured against: memory traffic of the same size, with no arithmetic, in the same process.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "rainref/executor.h"

namespace rainref::bench {

inline double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What a pass moves, at the least, for each texel.
struct Traffic {
  int read;     ///< bytes that are only read
  int updated;  ///< bytes that are written; they are read too, as the pass or the cache does
};

/// Seconds to stream over width x height texels in place: the best of many goes, on tiles of whole rows.
inline double stream_seconds(const parallel::Executor& executor, int width, int height, int tile_rows, Traffic traffic) {
  const std::size_t in_row = static_cast<std::size_t>(width) * traffic.read / sizeof(std::uint64_t);
  const std::size_t out_row = static_cast<std::size_t>(width) * traffic.updated / sizeof(std::uint64_t);
  std::vector<std::uint64_t> in(in_row * height, 0x0123456789abcdefu), out(out_row * height, 0x55u);
  const auto rows = [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      const std::uint64_t* from = in.data() + in_row * y;
      std::uint64_t* to = out.data() + out_row * y;
      const std::size_t both = std::min(in_row, out_row);
      std::uint64_t rest = 0;
      for (std::size_t i = 0; i < both; ++i) to[i] ^= from[i];
      for (std::size_t i = both; i < in_row; ++i) rest ^= from[i];
      for (std::size_t i = both; i < out_row; ++i) to[i] ^= 1;
      to[0] ^= rest;  // or the reading would be left out
    }
  };
  double best = 1e9, total = 0;
  for (int go = 0; go < 5 || (total < 0.1 && go < 2000); ++go) {
    const double seconds = seconds_of([&] { executor.for_tiles(width, height, width, tile_rows, rows); });
    best = std::min(best, seconds);
    total += seconds;
  }
  return best;
}

}  // namespace rainref::bench
