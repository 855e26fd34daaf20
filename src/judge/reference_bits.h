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

  /// Whether an evaluation of the pass says what is stored of halves by the rounding of this place among the modes: where it rounds inside,
  /// by the reference's own alone.
  bool has_reference(std::size_t mode) const;
  /// Whether the port has for an invocation what the reference stores, by each of two roundings.
  std::array<bool, 2> stores(int x, int y) const;
  /// Computes what the reference stores by the rounding of this place, or with `every` by all that are tried.
  void prepare(const parallel::Executor& executor, std::size_t leading, bool every);
  /// Whether all that is stored for an invocation, free values too, has the reference's bits by the mode of this place, or by either
  /// rounding where a mixture is asked for. False where the pass has no such reference: where it rounds inside, the reference's own
  /// rounding alone has one.
  bool has(std::size_t mode, int x, int y) const;
  /// Whether `count` invocations of a row, from x on, have the bits of the expected outputs, zeros of one sign. All bytes are compared at
  /// once, so where this is false has() may still be true of each.
  bool have_expected(int x, int y, int count) const;
  /// Whether the expected outputs are the reference by the mode of this place.
  bool is_expected(std::size_t mode) const { return modes_[mode] == HalfMode::either || is_own_rounding(slots_, modes_[mode]); }

 private:
  template <class ArrayOf>
  bool equals(const ArrayOf& reference, int x, int y) const;

  const capture::PassCase& case_;
  const capture::PassModel& model_;
  const std::vector<capture::Array>& port_;
  const std::vector<Slot>& slots_;
  const std::vector<HalfMode>& modes_;
  std::array<std::vector<capture::Array>, 2> other_;  // by mode, where that is another rounding than the reference's own
};

}  // namespace rainref::judge
