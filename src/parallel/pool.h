// The threads behind an Executor: oneTBB's, or plain ones under the thread sanitizer.
//
// oneTBB is not built with that sanitizer, which therefore sees no order in what its workers do: either everything is reported or,
// with the library suppressed, nothing. Plain threads that take turns with the tiles order nothing but start and end of a loop, so that
// neighbouring tiles which touch the same memory are reported.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "rainref/executor.h"

namespace rainref::parallel {

#if defined(__SANITIZE_THREAD__)
#define RAINREF_PLAIN_THREADS 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define RAINREF_PLAIN_THREADS 1
#endif
#endif

struct Executor::Pool {
  /// 0 threads: one for each processor that this process may use.
  explicit Pool(int threads);
  ~Pool();
  int threads() const;
  /// Calls body(i) for i in [0, count), each on any thread. Rethrows the first exception of a body.
  void run(std::int64_t count, const std::function<void(std::int64_t)>& body, Placement placement) const;

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace rainref::parallel
