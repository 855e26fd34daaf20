// rainref's own thread pool, which runs fixed tiles. No other part knows about threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace rainref::parallel {

/// A half-open rectangle of texels.
struct Tile {
  int x0, y0, x1, y1;
};

/// A thread pool. Results never depend on the number of threads: the data size alone determines the tiles, and each tile runs with a fixed
/// floating-point state. A thread first runs its own share of the tiles. The share is the same in each loop with as many tiles, so the
/// thread's caches hold the data. Then the thread takes tiles of other threads. After 0.2 ms without a loop it sleeps.
class Executor {
 public:
  /// threads: 0 for one per processor that this process may use. Throws Error(usage) for a negative number or one above max_threads.
  explicit Executor(int threads = 0);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  static constexpr int max_threads = 1024;
  /// Number of threads; 1 in a build without threads.
  int threads() const;

  /// Runs body once for every tile of a width x height area. Tiles have at most tile_width x tile_height texels and start at the top left.
  /// Rethrows the first exception of a body. A body may write only the data of its tile.
  void for_tiles(int width, int height, int tile_width, int tile_height, const std::function<void(const Tile&)>& body) const;
  /// Runs body(i) for i in [0, count), in chunks of `chunk` consecutive indices. Throws Error(internal) for more than 2^31 chunks.
  void for_range(std::int64_t count, std::int64_t chunk, const std::function<void(std::int64_t begin, std::int64_t end)>& body) const;

  /// Hands tiles to the pool in an order shuffled by this seed (0: natural order). For tests of determinism.
  void shuffle_tiles(std::uint64_t seed) { shuffle_seed_ = seed; }

 private:
  struct Pool;
  std::unique_ptr<Pool> pool_;
  std::uint64_t shuffle_seed_ = 0;
};

}  // namespace rainref::parallel
