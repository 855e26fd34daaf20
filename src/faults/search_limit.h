// How long a search for causes may take. What is found then depends on the machine, so results that are compared have no limit.
#pragma once

#include <atomic>
#include <chrono>

namespace rainref::faults {

class SearchLimit {
 public:
  /// From now on. 0: as long as it takes.
  explicit SearchLimit(double seconds)
      : is_limited_(seconds > 0),
        end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  /// Whether the time is over. Any thread may ask.
  bool is_over() const {
    if (!is_limited_ || Clock::now() < end_) return false;
    was_met_ = true;
    return true;
  }
  /// Whether somebody was told so, and left something untried.
  bool was_met() const { return was_met_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool is_limited_;
  Clock::time_point end_;
  mutable std::atomic<bool> was_met_ = false;
};

}  // namespace rainref::faults
