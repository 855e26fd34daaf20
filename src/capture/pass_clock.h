// Data for a Recorder besides images: the time of a pass, and its lists.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include "rainref/recorder.h"

namespace rainref::capture {

/// Seconds since its construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Time that tiles spend in one pass, summed over all threads.
class PassClock {
 public:
  template <class Body>
  void add(const Body& body) {
    const Stopwatch watch;
    body();
    nanoseconds_ += static_cast<std::int64_t>(watch.seconds() * 1e9);
  }
  /// The pass's wall-clock time with this many threads.
  double seconds(int threads) const { return static_cast<double>(nanoseconds_) * 1e-9 / threads; }

 private:
  std::atomic<std::int64_t> nanoseconds_ = 0;
};

template <class T>
RecordView records(const std::vector<T>& all) {
  return {all.data(), all.size(), sizeof(T)};
}

}  // namespace rainref::capture
