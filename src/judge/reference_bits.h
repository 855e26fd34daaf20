// Finds the invocations of a port that have the reference's bits, up to the sign of a zero. They need no envelope.
//
// Every profile allows the reference's arithmetic. So the envelopes hold the reference's values, in one alternative for all outputs
// together. The store's codes include the code that the reference stores.
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
  /// `c.outputs` are the reference's. `port` as in judge_case, `modes`: the roundings of half stores to try. The arguments must outlive it.
  ReferenceBits(const capture::PassCase& c, const capture::PassModel& model, const std::vector<capture::Array>& port,
                const std::vector<Slot>& slots, const std::vector<HalfMode>& modes);

  /// True if an evaluation of the pass gives the stored values under the rounding modes[mode]. If the pass rounds inside: only under the
  /// reference's own rounding.
  bool has_reference(std::size_t mode) const;
  /// For each of two roundings: true if the port stored what the reference stores for an invocation.
  std::array<bool, 2> stores(int x, int y) const;
  /// Computes what the reference stores under the rounding modes[leading]; with `every`, under all roundings.
  void prepare(const parallel::Executor& executor, std::size_t leading, bool every);
  /// True if all stored values of an invocation, free ones too, have the reference's bits under modes[mode], or under either rounding if
  /// that is a mixture. False if there is no such reference: if the pass rounds inside, only the reference's own rounding has one.
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
  std::array<std::vector<capture::Array>, 2> other_;  // by mode, if that is not the reference's own rounding
};

}  // namespace rainref::judge
