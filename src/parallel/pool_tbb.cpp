#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include "parallel/pool.h"

namespace rainref::parallel {
namespace {

/// Pieces [first, end) that are left of a thread's share, in one word: it takes the first, others the last. A cache line for each.
struct alignas(64) Share {
  std::atomic<std::uint64_t> left{0};

  void set(std::uint64_t first, std::uint64_t end) { left.store(first | (end << 32), std::memory_order_relaxed); }
  /// A piece, or -1.
  std::int64_t take(bool is_own) {
    std::uint64_t now = left.load(std::memory_order_relaxed);
    for (;;) {
      const std::uint64_t first = now & 0xffffffffu, end = now >> 32;
      if (first >= end) return -1;
      const std::uint64_t rest = is_own ? ((first + 1) | (end << 32)) : (first | ((end - 1) << 32));
      if (left.compare_exchange_weak(now, rest, std::memory_order_relaxed)) return static_cast<std::int64_t>(is_own ? first : end - 1);
    }
  }
};

}  // namespace

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
  const auto all = static_cast<std::size_t>(threads()), pieces = static_cast<std::size_t>(count);
  threads_->arena.execute([&] {
    using Range = oneapi::tbb::blocked_range<std::size_t>;
    if (placement == Placement::same_thread) {
      const auto some = [&](const Range& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(static_cast<std::int64_t>(i));
      };
      oneapi::tbb::parallel_for(Range(0, pieces, 1), some, oneapi::tbb::static_partitioner());
      return;
    }
    // A thread begins with its own share, the same in each loop over as many rows, so that much of what it reads lies in its cache;
    // then it takes from the others'.
    std::vector<Share> shares(all);
    for (std::size_t k = 0; k < all; ++k) shares[k].set(pieces * k / all, pieces * (k + 1) / all);
    oneapi::tbb::task_group_context context;
    const auto work = [&](const Range&) {
      const auto own = static_cast<std::size_t>(oneapi::tbb::this_task_arena::current_thread_index());
      for (std::size_t k = 0; k < all; ++k) {
        Share& share = shares[(own + k) % all];
        for (std::int64_t i; !context.is_group_execution_cancelled() && (i = share.take(k == 0)) >= 0;) body(i);
      }
    };
    oneapi::tbb::parallel_for(Range(0, std::min(all, pieces), 1), work, oneapi::tbb::simple_partitioner(), context);
  });
}

}  // namespace rainref::parallel
