// The goes of a row: the fastest, for the rate, and the quartiles, for the spread.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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
  /// go() gives the seconds of one go. Google Benchmark finds out by whole runs of a row, with all that it is made of, how many goes fill
  /// its least time; scripts/bench asks for one and has it made of several here instead, by RAINREF_BENCH_SECONDS.
  template <class Go>
  void add(const Go& go) {
    static const double least = std::getenv("RAINREF_BENCH_SECONDS") == nullptr ? 0 : std::atof(std::getenv("RAINREF_BENCH_SECONDS"));
    double total = 0;
    int made = 0;
    do {
      seconds_.push_back(go());
      total += seconds_.back();
      ++made;
    } while (least > 0 && (made < 5 || total < least));
    state_.SetIterationTime(total / made);
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
