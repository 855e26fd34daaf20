// The threads behind an Executor. CMake compiles one of pool_tbb.cpp, pool_team.cpp (without oneTBB), pool_threads.cpp (under the thread
// sanitizer) and pool_serial.cpp (WebAssembly).
//
// oneTBB is not built with that sanitizer, which therefore sees no order between its workers: it reports either everything or, with the
// library suppressed, nothing. Plain threads that take tiles in turn are ordered only by the start and end of a loop. So neighbouring tiles
// that touch the same memory are reported.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

#include "rainref/executor.h"

namespace rainref::parallel {

/// Processors by the standard library, which may not know them; at least 1.
inline int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

struct Executor::Pool {
  /// 0 threads: one for each processor that this process may use. The serial pool always has one.
  explicit Pool(int threads);
  ~Pool();
  int threads() const;
  static constexpr std::int64_t most_pieces = std::int64_t{1} << 31;
  /// Calls body(i) for i in [0, count), count <= most_pieces, each on any thread. Rethrows the first exception of a body; pieces that have
  /// not started by then may be skipped.
  void run(std::int64_t count, const std::function<void(std::int64_t)>& body) const;

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace rainref::parallel
