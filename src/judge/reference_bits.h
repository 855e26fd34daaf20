// Which invocations of a port have the reference's bits, but for the sign of a zero: they need no envelope.
//
// Every profile allows what the reference does, so each of its envelopes, in one alternative for all outputs together, holds the
// reference's values, and the store's codes the code that the reference stores. What has those bits lies inside.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "capture/pass_model.h"
#include "judge/sample.h"
#include "judge/slots.h"
#include "judge/verdict.h"
#include "rainref/executor.h"

namespace rainref::judge {

class ReferenceBits {
 public:
  /// `c.outputs` are the reference's. `port` as in judge_case, `modes` the roundings of half stores that are tried. What is given must
  /// outlive it.
  ReferenceBits(const capture::PassCase& c, const capture::PassModel& model, const std::vector<capture::Array>& port,
                const std::vector<Slot>& slots, const std::vector<HalfMode>& modes);

  /// Counts what of the sample is stored by each of two roundings.
  void count(const Sample& sample);
  std::int64_t counted(std::size_t mode) const { return mode < counts_.size() ? counts_[mode] : 0; }
  /// Finds the rounding that most is counted of, or with `every` all that are tried, and computes what the reference stores so.
  void prepare(const parallel::Executor& executor, bool every);
  /// The place of that rounding among the modes: what it leaves unasked is known to lie inside by this rounding, not by the other.
  std::size_t leading() const { return leading_; }
  /// Whether all that is stored for an invocation, free values too, has the reference's bits by the mode of this place, or by either
  /// rounding where a mixture is asked for. False where the pass has no such reference: where it rounds inside, or is judged near what is
  /// stored, the reference's own rounding alone has one.
  bool has(std::size_t mode, int x, int y) const;

 private:
  bool is_own(HalfMode mode) const;
  bool has_reference(HalfMode mode) const;
  template <class ArrayOf>
  bool equals(const ArrayOf& reference, int x, int y) const;

  const capture::PassCase& case_;
  const capture::PassModel& model_;
  const std::vector<capture::Array>& port_;
  const std::vector<Slot>& slots_;
  const std::vector<HalfMode>& modes_;
  std::array<std::vector<capture::Array>, 2> other_;  // by mode, where that is another rounding than the reference's own
  std::array<std::int64_t, 2> counts_{};
  std::size_t leading_ = 0;
};

}  // namespace rainref::judge
