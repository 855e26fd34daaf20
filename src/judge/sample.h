// The invocations whose envelopes are computed for a report's statistics: widths, and shares of elements without a bound.
//
// A run is divided row by row into strata of equally many invocations, and one invocation of each stratum is drawn. A total over the run is
// estimated as the length of a stratum times the sample's total. Hoeffding's inequality bounds the error.
#pragma once

#include <algorithm>
#include <cstdint>

#include "capture/pass_model.h"

namespace rainref::judge {

/// Least number of invocations of a pass to compute, over all its runs, if it has that many.
inline constexpr std::int64_t least_sample = 16384;

/// If this many sampled invocations fail under every rounding, the rest is not judged: the search for causes uses no more.
inline constexpr std::int64_t enough_failing = 400;

/// Least number of invocations of a run, from `least` for all runs: its share, but enough to decide whether half of its elements have a
/// bound. `invocations`: of the run; `of`: of all runs together.
std::int64_t sample_of_run(std::int64_t least, std::int64_t invocations, std::int64_t of);

/// Number of invocations of a run, from the sizes of its outputs.
template <class Outputs, class ArrayOf>
std::int64_t invocations_of(const Outputs& outputs, const ArrayOf& array_of) {
  std::int64_t most = 0;
  for (const auto& o : outputs) most = std::max(most, static_cast<std::int64_t>(array_of(o).width) * array_of(o).height);
  return most;
}

class Sample {
 public:
  /// Draws at least `least` invocations. The draw depends on the run's uniforms and expected outputs, so not on the port. Takes all if
  /// `least` is 0, or more than half of them.
  Sample(const capture::PassCase& c, const capture::PassModel& model, std::int64_t least);

  bool is_whole() const { return stride_ == 1; }
  bool has(int x, int y) const { return is_whole() || drawn(index(x, y) / stride_) == index(x, y); }
  /// Number of invocations that one of the sample represents.
  std::int64_t stride() const { return stride_; }
  /// Number of sampled invocations.
  std::int64_t size() const { return (count_ + stride_ - 1) / stride_; }
  /// Calls visit(x, y) for each sampled invocation, or for each `step`th.
  template <class Visit>
  void each(std::int64_t step, Visit visit) const {
    for (std::int64_t k = 0; k * stride_ < count_; k += step)
      if (const std::int64_t at = drawn(k); at < count_) visit(static_cast<int>(at % width_), static_cast<int>(at / width_));
  }
  /// The same for the strata `first` to `end` - 1 of size().
  template <class Visit>
  void each_of(std::int64_t first, std::int64_t end, Visit visit) const {
    for (std::int64_t k = first; k < end; ++k)
      if (const std::int64_t at = drawn(k); at < count_) visit(static_cast<int>(at % width_), static_cast<int>(at / width_));
  }
  /// Calls visit(begin, end) for each run of consecutive invocations outside the sample, among those from `first` to `last` - 1.
  /// Invocations are numbered row by row.
  template <class Visit>
  void each_left_out(std::int64_t first, std::int64_t last, Visit visit) const {
    if (is_whole()) return;
    for (std::int64_t k = first / stride_; first < last; ++k) {
      const std::int64_t at = drawn(k);
      if (at < first) continue;
      if (first < at) visit(first, std::min(at, last));
      first = at + 1;
    }
  }
  /// Margin of error: stride() times the sample's count, of at most `values` for each invocation, differs from the true count by at most
  /// this, except with probability 2^-40. 0 if the sample is complete.
  double margin(double values) const;

 private:
  std::int64_t index(int x, int y) const { return static_cast<std::int64_t>(y) * width_ + x; }
  std::int64_t drawn(std::int64_t stratum) const;

  std::int64_t width_, count_, stride_ = 1;
  std::uint64_t seed_ = 0;
};

}  // namespace rainref::judge
