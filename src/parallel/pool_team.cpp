// Threads of the standard library, for builds without oneTBB. They sleep between frames.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "parallel/pool.h"
#include "parallel/team.h"

namespace rainref::parallel {
namespace {

/// What the pool and its threads share. It lives as long as the last of them.
struct Shared {
  explicit Shared(int count) : threads(count), team(count) {}

  const int threads;
  Team team;
  std::mutex mutex;  // of all below
  std::condition_variable wake;
  std::uint64_t loops = 0;
  bool started = false, stopped = false;
};

void help(const std::shared_ptr<Shared>& shared, int place) {
  const std::chrono::nanoseconds wait = patience(shared->threads, processors());
  std::uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(shared->mutex);
      shared->wake.wait(lock, [&] { return shared->stopped || shared->loops != seen; });
      if (shared->stopped) return;
      seen = shared->loops;
    }
    shared->team.help(place, wait);
  }
}

/// The threads but the caller. If the system gives fewer, those that are there do all the work.
void start(const std::shared_ptr<Shared>& shared) {
  try {
    for (int place = 1; place < shared->threads; ++place) std::thread(help, shared, place).detach();
  } catch (const std::system_error&) {
  }
}

}  // namespace

struct Executor::Pool::Threads {
  std::shared_ptr<Shared> shared;
};

Executor::Pool::Pool(int threads) : threads_(new Threads{std::make_shared<Shared>(threads == 0 ? processors() : threads)}) {}

// The threads are not joined: after a fork the child has none of them, and would wait for ever.
Executor::Pool::~Pool() {
  Shared& shared = *threads_->shared;
  shared.team.stop();
  {
    const std::lock_guard lock(shared.mutex);
    shared.stopped = true;
  }
  shared.wake.notify_all();
}

int Executor::Pool::threads() const { return threads_->shared->threads; }

void Executor::Pool::run(std::int64_t count, const std::function<void(std::int64_t)>& body) const {
  const std::shared_ptr<Shared>& shared = threads_->shared;
  const auto call_helpers = [&] {
    {
      const std::lock_guard lock(shared->mutex);
      ++shared->loops;
      if (!std::exchange(shared->started, true)) start(shared);
    }
    shared->wake.notify_all();
  };
  if (std::min<std::int64_t>(threads(), count) > 1 && shared->team.run(count, body, call_helpers)) return;
  // One thread or piece, a loop within a loop, or a loop of another thread at the same time.
  for (std::int64_t i = 0; i < count; ++i) body(i);
}

}  // namespace rainref::parallel
