// What a rearrangement of the formula would accept, asked of an invocation that the formula as written does not hold.
#pragma once

#include <vector>

#include "judge/alternatives.h"
#include "judge/stored.h"

namespace rainref::judge {

/// A pass, the slots of its outputs, and the profile that it is judged by. What it refers to must outlive it.
class SecondTier {
 public:
  SecondTier(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile)
      : slots_(slots), model_(model), profile_(profile) {}

  /// Whether the profile has one.
  bool exists() const { return profile_.rearrangement != enclosed::Rearrangement::none; }
  /// Whether some alternative of these rearrangements gives all that was stored, and usefully bounds each value that `nearest`, the
  /// codes of the formula as written, does not hold. False where the pass has no evaluation for them.
  bool accepts(enclosed::Rearrangement how, int x, int y, const Stored& stored, const std::vector<enclosed::CodeRange>& nearest,
               HalfMode mode);
  /// The same of what run() gave.
  bool accepts(const Alternatives& all, const Stored& stored, const std::vector<enclosed::CodeRange>& nearest, HalfMode mode);
  /// Whether what was stored lies near some alternative of the last accepts(): at most four times as many codes away as it accepts. A
  /// product of two sums, of at most four terms together with its sums 7 roundings, has 31 when it is multiplied out: each no larger, but
  /// where its terms cancel. Of `nearest` where the pass has no evaluation for rearrangements.
  bool is_near(const Stored& stored, const std::vector<enclosed::CodeRange>& nearest, HalfMode mode);
  /// Every alternative of these rearrangements, into `all`.
  void run(enclosed::Rearrangement how, int x, int y, const Stored& stored, HalfMode mode, Alternatives& all) const;
  /// The codes of the first alternative; null where there is none.
  const std::vector<enclosed::CodeRange>* codes(int x, int y, const Stored& stored, HalfMode mode);

 private:
  const std::vector<Slot>& slots_;
  const capture::PassModel& model_;
  const enclosed::Profile& profile_;
  Alternatives all_;
  std::vector<enclosed::CodeRange> ranges_;
};

}  // namespace rainref::judge
