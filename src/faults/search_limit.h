// Time limit of a search for causes. A limited result depends on the machine, so results that are compared have no limit.
#pragma once

#include <atomic>
#include <chrono>

namespace rainref::faults {

class SearchLimit {
 public:
  /// Starts now. 0: no limit.
  explicit SearchLimit(double seconds)
      : is_limited_(seconds > 0),
        end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  /// True if the time is over. Thread-safe.
  bool is_over() const {
    if (!is_limited_ || Clock::now() < end_) return false;
    was_met_ = true;
    return true;
  }
  /// True if is_over() returned true, so that something was left untried.
  bool was_met() const { return was_met_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool is_limited_;
  Clock::time_point end_;
  mutable std::atomic<bool> was_met_ = false;
};

}  // namespace rainref::faults
