#include "rainref/executor.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "parallel/pool.h"
#include "rainref/error.h"

namespace rainref::parallel {

Executor::Executor(int threads) {
  const FloatingPointGuard guard;
  if (threads < 0 || threads > max_threads) {
    throw Error(ExitCode::usage, fmt::format("threads: expected a number from 1 to {}, found {}", max_threads, threads));
  }
  pool_ = std::make_unique<Pool>(threads);
}

Executor::~Executor() = default;

int Executor::threads() const { return pool_->threads(); }

void Executor::for_range(std::int64_t count, std::int64_t chunk, const std::function<void(std::int64_t, std::int64_t)>& body) const {
  if (count <= 0) return;
  const FloatingPointGuard caller;
  const std::int64_t chunks = (count - 1) / chunk + 1;
  if (chunks > Pool::most_pieces) throw Error(ExitCode::internal, fmt::format("a loop of {} pieces: at most 2^31 are handed out", chunks));
  std::vector<std::int64_t> order;
  if (shuffle_seed_ != 0) {
    order.resize(static_cast<std::size_t>(chunks));
    std::iota(order.begin(), order.end(), std::int64_t{0});
    std::uint64_t state = shuffle_seed_;
    for (std::size_t i = order.size(); i > 1; --i) {
      state = state * 6364136223846793005u + 1442695040888963407u;  // Knuth's MMIX generator; it only affects the order
      std::swap(order[i - 1], order[(state >> 33) % i]);
    }
  }
  const auto run_chunk = [&](std::int64_t i) {
    const std::int64_t index = order.empty() ? i : order[static_cast<std::size_t>(i)];
    const FloatingPointGuard guard;
    body(index * chunk, index * chunk + std::min(chunk, count - index * chunk));
  };
  pool_->run(chunks, run_chunk);
}

void Executor::for_tiles(int width, int height, int tile_width, int tile_height, const std::function<void(const Tile&)>& body) const {
  const int columns = (width + tile_width - 1) / tile_width, rows = (height + tile_height - 1) / tile_height;
  const auto tiles = [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const int x = static_cast<int>(i % columns) * tile_width, y = static_cast<int>(i / columns) * tile_height;
      body({x, y, std::min(width, x + tile_width), std::min(height, y + tile_height)});
    }
  };
  for_range(static_cast<std::int64_t>(columns) * rows, 1, tiles);
}

}  // namespace rainref::parallel
