// The threads that take part in consecutive loops. A frame runs dozens of short loops, and waking a thread takes time. So a thread that has
// done its part waits briefly for the next loop before it leaves.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

namespace rainref::parallel {

/// How long a helper waits for the next loop: longer than the time between the loops of a frame. Not at all if threads share processors,
/// because one that waits keeps others from its processor.
inline std::chrono::nanoseconds patience(int threads, int processors) { return std::chrono::microseconds(threads <= processors ? 200 : 0); }

/// Any thread may run loops; one at a time gets the team. Any other thread may help. The caller owns the threads.
class Team {
 public:
  /// At most `threads` take part in a loop: the one that runs it, and helpers with places 1 to threads - 1.
  explicit Team(int threads) : threads_(static_cast<std::size_t>(threads)) {}
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls body(i) for i in [0, count), count < 2^32, on this thread and on all helpers. Calls begun() when others may take pieces. Returns
  /// when all are done. Rethrows the first exception of a body; pieces that have not started by then may be skipped. Returns false, without
  /// doing anything, while another loop runs.
  bool run(std::int64_t count, const std::function<void(std::int64_t)>& body, const std::function<void()>& begun);
  /// Takes part in every loop until there has been none for `patience`, or until stop(). place: 1 to threads - 1, used by one thread at a
  /// time.
  void help(int place, std::chrono::nanoseconds patience);
  /// Makes helpers leave as soon as they have no loop.
  void stop() { stopped_.store(true, std::memory_order_relaxed); }

 private:
  /// Remaining pieces [first, end) of a thread's share, in one word. The owner takes the first, others the last. Each has its own cache
  /// line.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> left{0};

    void set(std::uint64_t first, std::uint64_t end) { left.store(first | (end << 32), std::memory_order_relaxed); }
    /// A piece, or -1.
    std::int64_t take(bool is_own);
  };
  struct Loop {
    const std::function<void(std::int64_t)>& body;
    std::vector<Share> shares;
    std::atomic<bool> failed{false};
    std::exception_ptr error;
  };
  static void work(Loop& loop, std::size_t place);

  // The number of the loop, whether threads may still join it, and how many take part.
  static constexpr std::uint64_t one_loop = std::uint64_t{1} << 32, open = std::uint64_t{1} << 31, taking_part = open - 1;

  const std::size_t threads_;
  std::atomic<bool> taken_{false}, stopped_{false};
  alignas(64) std::atomic<std::uint64_t> state_{0};
  Loop* loop_ = nullptr;  // whose participants `state_` counts
};

}  // namespace rainref::parallel
