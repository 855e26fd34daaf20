// Plain threads that take the pieces in turn, for the thread sanitizer: parallel/pool.h.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "parallel/pool.h"

namespace rainref::parallel {

struct Executor::Pool::Threads {
  int count;
};

Executor::Pool::Pool(int threads) : threads_(new Threads{threads == 0 ? processors() : threads}) {}
Executor::Pool::~Pool() = default;

int Executor::Pool::threads() const { return threads_->count; }

void Executor::Pool::run(std::int64_t count, const std::function<void(std::int64_t)>& body) const {
  // Neighbouring tiles always run on different threads, whatever the machine's load.
  const std::int64_t threads = std::min<std::int64_t>(threads_->count, count);
  std::atomic<bool> failed{false};
  std::exception_ptr first;
  std::mutex first_mutex;
  const auto work = [&](std::int64_t thread) {
    try {
      for (std::int64_t i = thread; i < count && !failed.load(std::memory_order_relaxed); i += threads) body(i);
    } catch (...) {
      failed.store(true, std::memory_order_relaxed);
      const std::lock_guard lock(first_mutex);
      if (!first) first = std::current_exception();
    }
  };
  std::vector<std::thread> workers;
  for (std::int64_t k = 1; k < threads; ++k) workers.emplace_back(work, k);
  work(0);
  for (std::thread& worker : workers) worker.join();
  if (first) std::rethrow_exception(first);
}

}  // namespace rainref::parallel
