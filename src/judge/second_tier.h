// If the formula as written does not accept an invocation, tests the formula's rearrangements.
#pragma once

#include <vector>

#include "judge/alternatives.h"
#include "judge/stored.h"

namespace rainref::judge {

/// A pass, the slots of its outputs, and its profile. The arguments must outlive it.
class SecondTier {
 public:
  SecondTier(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile)
      : slots_(slots), model_(model), profile_(profile) {}

  /// True if the profile allows rearrangements.
  bool exists() const { return profile_.rearrangement != enclosed::Rearrangement::none; }
  /// True if some alternative of these rearrangements gives all stored values, and usefully bounds each value outside `nearest`, the codes
  /// of the formula as written. False if the pass has no evaluation for them.
  bool accepts(enclosed::Rearrangement how, int x, int y, const Stored& stored, const std::vector<enclosed::CodeRange>& nearest,
               HalfMode mode);
  /// The same for the result of run().
  bool accepts(const Alternatives& all, const Stored& stored, const std::vector<enclosed::CodeRange>& nearest, HalfMode mode);
  /// True if the stored values are near some alternative of the last accepts(): at most four times its width away, in codes. A product of
  /// two sums with at most four terms together has 7 roundings with its sums, and 31 when multiplied out: each is no larger, unless terms
  /// cancel. Uses `nearest` if the pass has no evaluation for rearrangements.
  bool is_near(const Stored& stored, const std::vector<enclosed::CodeRange>& nearest, HalfMode mode);
  /// Evaluates all alternatives of these rearrangements into `all`.
  void run(enclosed::Rearrangement how, int x, int y, const Stored& stored, HalfMode mode, Alternatives& all) const;
  /// Codes of the first alternative; null if there is none.
  const std::vector<enclosed::CodeRange>* codes(int x, int y, const Stored& stored, HalfMode mode);

 private:
  const std::vector<Slot>& slots_;
  const capture::PassModel& model_;
  const enclosed::Profile& profile_;
  Alternatives all_;
  std::vector<enclosed::CodeRange> ranges_;
};

}  // namespace rainref::judge
