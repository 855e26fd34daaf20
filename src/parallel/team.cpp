#include "parallel/team.h"

#include <thread>

namespace rainref::parallel {
namespace {

constexpr unsigned looks = 4096;  // some microseconds of polling, before the processor is yielded

}  // namespace

std::int64_t Team::Share::take(bool is_own) {
  std::uint64_t now = left.load(std::memory_order_relaxed);
  for (;;) {
    const std::uint64_t first = now & 0xffffffffu, end = now >> 32;
    if (first >= end) return -1;
    const std::uint64_t rest = is_own ? ((first + 1) | (end << 32)) : (first | ((end - 1) << 32));
    if (left.compare_exchange_weak(now, rest, std::memory_order_relaxed)) return static_cast<std::int64_t>(is_own ? first : end - 1);
  }
}

// A thread begins with its own share, which is the same in each loop over this number of pieces, so that its cache holds much of the data;
// then it takes from the others.
void Team::work(Loop& loop, std::size_t place) {
  try {
    const std::size_t all = loop.shares.size();
    for (std::size_t k = 0; k < all; ++k) {
      Share& share = loop.shares[(place + k) % all];
      for (std::int64_t i; !loop.failed.load(std::memory_order_relaxed) && (i = share.take(k == 0)) >= 0;) loop.body(i);
    }
  } catch (...) {
    if (!loop.failed.exchange(true, std::memory_order_relaxed)) loop.error = std::current_exception();
  }
}

bool Team::run(std::int64_t count, const std::function<void(std::int64_t)>& body, const std::function<void()>& begun) {
  if (taken_.exchange(true, std::memory_order_acquire)) return false;
  const auto pieces = static_cast<std::uint64_t>(count);
  Loop loop{body, std::vector<Share>(threads_), {}, {}};
  for (std::size_t k = 0; k < threads_; ++k) loop.shares[k].set(pieces * k / threads_, pieces * (k + 1) / threads_);
  loop_ = &loop;
  const std::uint64_t last = state_.load(std::memory_order_relaxed);  // closed, and no thread takes part
  state_.store((last / one_loop + 1) * one_loop | open, std::memory_order_release);
  begun();
  work(loop, 0);
  // Nothing is left to take; pieces already taken must finish before the loop's memory is freed.
  state_.fetch_and(~open, std::memory_order_relaxed);
  for (unsigned k = 0; (state_.load(std::memory_order_acquire) & taking_part) != 0; ++k) {
    if (k % looks == looks - 1) std::this_thread::yield();
  }
  const std::exception_ptr error = loop.error;
  taken_.store(false, std::memory_order_release);
  if (error) std::rethrow_exception(error);
  return true;
}

void Team::help(int place, std::chrono::nanoseconds patience) {
  using Clock = std::chrono::steady_clock;
  std::uint64_t seen = 0;  // the last loop in which this thread took part
  Clock::time_point idle_since = Clock::now();
  for (unsigned k = 0; !stopped_.load(std::memory_order_relaxed); ++k) {
    std::uint64_t state = state_.load(std::memory_order_relaxed);
    if ((state & open) != 0 && state / one_loop != seen) {
      if (!state_.compare_exchange_strong(state, state + 1, std::memory_order_acquire)) continue;
      seen = state / one_loop;
      work(*loop_, static_cast<std::size_t>(place));
      state_.fetch_sub(1, std::memory_order_release);
      idle_since = Clock::now();
      k = 0;
      continue;
    }
    if (k % looks == 0) {
      if (Clock::now() - idle_since >= patience) return;
      std::this_thread::yield();
    }
  }
}

}  // namespace rainref::parallel
