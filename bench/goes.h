// The goes of a row: the fastest, for the rate, and the quartiles, for the spread.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rainref::bench {

/// The value below which a share p of the sorted values lies, between neighbours by proportion (NumPy's default rule). values: at least
/// one; p in 0..1.
inline double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1), below = std::floor(at);
  const auto i = static_cast<std::size_t>(below);
  const double low = values[i], high = values[std::min(i + 1, values.size() - 1)];
  return low + (at - below) * (high - low);
}

class Goes {
 public:
  explicit Goes(benchmark::State& state) : state_(state) {}
  void add(double seconds) {
    seconds_.push_back(seconds);
    state_.SetIterationTime(seconds);
  }
  /// Seconds of the fastest, because other work on the machine only ever slows a go down. Leaves the quartiles in the row.
  double best() {
    state_.counters["goes"] = static_cast<double>(seconds_.size());
    state_.counters["q1_ms"] = 1e3 * quantile(seconds_, 0.25);
    state_.counters["median_ms"] = 1e3 * quantile(seconds_, 0.5);
    state_.counters["q3_ms"] = 1e3 * quantile(seconds_, 0.75);
    const double fastest = *std::min_element(seconds_.begin(), seconds_.end());
    state_.counters["best_ms"] = 1e3 * fastest;
    return fastest;
  }

 private:
  benchmark::State& state_;
  std::vector<double> seconds_;
};

}  // namespace rainref::bench
