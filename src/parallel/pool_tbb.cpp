#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "parallel/pool.h"

namespace rainref::parallel {

struct Executor::Pool::Threads {
  oneapi::tbb::task_arena arena;
};

Executor::Pool::Pool(int threads)
    : threads_(new Threads{oneapi::tbb::task_arena(threads == 0 ? oneapi::tbb::info::default_concurrency() : threads)}) {
  // The scheduler starts no more workers than the machine has processors unless told to, and a proof over 8 threads on
  // 2 processors needs 8. One limit for the process: of several, the smallest would hold for every pool.
  static const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, max_threads);
  threads_->arena.initialize();
}
Executor::Pool::~Pool() = default;

int Executor::Pool::threads() const { return threads_->arena.max_concurrency(); }

void Executor::Pool::run(std::int64_t count, const std::function<void(std::int64_t)>& body, Placement placement) const {
  using Range = oneapi::tbb::blocked_range<std::int64_t>;
  const Range all(0, count, 1);
  const auto some = [&](const Range& range) {
    for (std::int64_t i = range.begin(); i != range.end(); ++i) body(i);
  };
  threads_->arena.execute([&] {
    if (placement == Placement::same_thread)
      oneapi::tbb::parallel_for(all, some, oneapi::tbb::static_partitioner());
    else
      oneapi::tbb::parallel_for(all, some, oneapi::tbb::simple_partitioner());
  });
}

}  // namespace rainref::parallel
