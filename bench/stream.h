// The bound that a pass is measured against: memory traffic of the same size, with no arithmetic, in the same process.
#pragma once

#include <chrono>
#include <cstdint>

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

/// Seconds to stream over width x height texels in place, in the vectors of the kernels: the best of many goes, on tiles of whole rows.
double stream_seconds(const parallel::Executor& executor, int width, int height, int tile_rows, Traffic traffic);

}  // namespace rainref::bench
