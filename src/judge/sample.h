// The invocations whose envelopes are asked for what a report says of them: how wide they are, and how many bound nothing.
//
// The run is cut into strata of equally many invocations, row by row, and one of each is drawn. So a total over the run is the strata's
// length times the sample's, but for chance, and Hoeffding's inequality says how far chance takes it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "capture/pass_model.h"

namespace rainref::judge {

/// Invocations of a pass that are asked at least, where it has so many: of all its runs together.
inline constexpr std::int64_t least_sample = 16384;

/// Where so many sampled invocations fail under every rounding, the rest would say no more: the search for causes looks at no more.
inline constexpr std::int64_t enough_failing = 400;

/// What a run is asked at least, of `least` in all runs: its share, but enough to tell whether half of its elements have a bound.
/// `invocations`: of the run; `of`: of all runs together.
std::int64_t sample_of_run(std::int64_t least, std::int64_t invocations, std::int64_t of);

/// Invocations of a run, as far as the sizes of its outputs tell.
template <class Outputs, class ArrayOf>
std::int64_t invocations_of(const Outputs& outputs, const ArrayOf& array_of) {
  std::int64_t most = 0;
  for (const auto& o : outputs) most = std::max(most, static_cast<std::int64_t>(array_of(o).width) * array_of(o).height);
  return most;
}

class Sample {
 public:
  /// At least `least` invocations of the run, drawn by its uniforms and expected outputs, so by nothing that a port says; all of them
  /// where `least` is 0, or more than half as many as there are.
  Sample(const capture::PassCase& c, const capture::PassModel& model, std::int64_t least);

  bool is_whole() const { return stride_ == 1; }
  bool has(int x, int y) const { return is_whole() || drawn(index(x, y) / stride_) == index(x, y); }
  /// How many invocations one of the sample stands for.
  std::int64_t stride() const { return stride_; }
  /// How many invocations it has.
  std::int64_t size() const { return (count_ + stride_ - 1) / stride_; }
  /// Calls visit(x, y) with each invocation of the sample, or with each `step`th.
  template <class Visit>
  void each(std::int64_t step, Visit visit) const {
    for (std::int64_t k = 0; k * stride_ < count_; k += step)
      if (const std::int64_t at = drawn(k); at < count_) visit(static_cast<int>(at % width_), static_cast<int>(at / width_));
  }
  /// The same with those of some strata, `first` to `end` - 1; there are size() of them.
  template <class Visit>
  void each_of(std::int64_t first, std::int64_t end, Visit visit) const {
    for (std::int64_t k = first; k < end; ++k)
      if (const std::int64_t at = drawn(k); at < count_) visit(static_cast<int>(at % width_), static_cast<int>(at / width_));
  }
  /// Calls visit(begin, end) with each run of consecutive invocations that the sample leaves out, of those from `first` to `last` - 1,
  /// by number, row by row.
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
  /// stride() times what the sample counts, at most `values` of an invocation, lies on either side no farther from the count over all
  /// invocations than this, but once in 2^40 cases. 0 of a whole sample.
  double margin(double values) const;

 private:
  std::int64_t index(int x, int y) const { return static_cast<std::int64_t>(y) * width_ + x; }
  std::int64_t drawn(std::int64_t stratum) const;

  std::int64_t width_, count_, stride_ = 1;
  std::uint64_t seed_ = 0;
};

}  // namespace rainref::judge
