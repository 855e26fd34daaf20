// Fixed tiles on a thread pool of our own: the only place that knows about threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace rainref::parallel {

/// A half-open rectangle of texels.
struct Tile {
  int x0, y0, x1, y1;
};

/// A pool of threads of its own. Results never depend on the number of threads: work is cut into tiles by the size
/// of the data alone, and each tile runs with the floating-point state pinned. A thread begins with its share of the pieces, the same in
/// each loop of as many, whose data its caches hold, and then takes from the others'; without a loop for 0.2 ms it sleeps.
class Executor {
 public:
  /// threads >= 1, or 0 for one per processor that this process may use. Throws Error(usage) when negative or above
  /// max_threads.
  explicit Executor(int threads = 0);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  static constexpr int max_threads = 1024;
  /// As many as were asked for; 1 in a build without threads.
  int threads() const;

  /// Runs body once for every tile of a width x height area, tiles of at most tile_width x tile_height from the top
  /// left. Rethrows the first exception of a body. body must write only what its tile owns.
  void for_tiles(int width, int height, int tile_width, int tile_height, const std::function<void(const Tile&)>& body) const;
  /// Runs body(i) for i in [0, count), in chunks of `chunk` consecutive indices. Throws Error(internal) for more than 2^31 chunks.
  void for_range(std::int64_t count, std::int64_t chunk, const std::function<void(std::int64_t begin, std::int64_t end)>& body) const;

  /// Hands tiles to the pool in an order shuffled by this seed (0: natural order). For proofs of determinism.
  void shuffle_tiles(std::uint64_t seed) { shuffle_seed_ = seed; }

 private:
  struct Pool;
  std::unique_ptr<Pool> pool_;
  std::uint64_t shuffle_seed_ = 0;
};

}  // namespace rainref::parallel
