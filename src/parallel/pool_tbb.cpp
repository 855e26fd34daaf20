#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "parallel/pool.h"
#include "parallel/team.h"

namespace rainref::parallel {
namespace {

struct Helpers {
  explicit Helpers(int threads) : team(threads) {}
  Team team;
  std::atomic<int> count{0};  // helpers that run or will run
};

}  // namespace

struct Executor::Pool::Threads {
  oneapi::tbb::task_arena arena;
  std::chrono::nanoseconds patience;
  std::shared_ptr<Helpers> helpers;  // a helper may outlive the pool
};

Executor::Pool::Pool(int threads)
    : threads_(new Threads{oneapi::tbb::task_arena(threads == 0 ? oneapi::tbb::info::default_concurrency() : threads), {}, nullptr}) {
  // The scheduler starts at most as many workers as the machine has processors unless told otherwise, and a test with 8 threads on 2
  // processors needs 8. There is one limit for the process, because of several the smallest would apply to every pool.
  static const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, max_threads);
  threads_->arena.initialize();
  threads_->helpers = std::make_shared<Helpers>(this->threads());
  threads_->patience = parallel::patience(this->threads(), oneapi::tbb::info::default_concurrency());
}
Executor::Pool::~Pool() { threads_->helpers->team.stop(); }

int Executor::Pool::threads() const { return threads_->arena.max_concurrency(); }

void Executor::Pool::run(std::int64_t count, const std::function<void(std::int64_t)>& body) const {
  const int parts = static_cast<int>(std::min<std::int64_t>(threads(), count));
  if (parts <= 1) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  const std::shared_ptr<Helpers>& helpers = threads_->helpers;
  const auto call_helpers = [&] {
    for (int there = helpers->count.load(std::memory_order_relaxed); there < parts - 1; ++there) {
      helpers->count.fetch_add(1, std::memory_order_relaxed);
      threads_->arena.enqueue([helpers, patience = threads_->patience] {
        helpers->team.help(oneapi::tbb::this_task_arena::current_thread_index(), patience);
        helpers->count.fetch_sub(1, std::memory_order_relaxed);
      });
    }
  };
  if (helpers->team.run(count, body, call_helpers)) return;
  // A loop within a loop, or one of another thread.
  threads_->arena.execute([&] { oneapi::tbb::parallel_for(std::int64_t{0}, count, body, oneapi::tbb::simple_partitioner()); });
}

}  // namespace rainref::parallel
