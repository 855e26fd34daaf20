// What a profile leaves without a bound, and no device comes to.
//
// Where a profile promises nothing of an operation, what is stored may be anything by its letter, and so may be what a comparison of the
// result decides. What lies outside the profile `coarsest` too, in every alternative and every rearrangement that the profile allows, is
// explained by no rounding: that is the distance. A device that conforms or is known lies inside, so a single such element would do; a
// share is asked for beside it, because a few may have a reason of their own, and a mistake of a port makes many.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/alternatives.h"
#include "judge/stored.h"

namespace rainref::judge {

inline constexpr double gross_share = 0.005;
/// A few texels around one comparison are no share of anything.
inline constexpr std::int64_t least_gross = 16;

/// Whether so many elements fail, of all in invocations that the profile leaves open: OutputJudgement::beyond and open.
inline bool is_gross(std::int64_t beyond, std::int64_t open) {
  return beyond >= least_gross && static_cast<double>(beyond) > gross_share * static_cast<double>(open);
}

/// Asks it of one invocation after the other. What it refers to must outlive it.
class Beyond {
 public:
  Beyond(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile);

  /// Whether no alternative of `coarsest` holds all that was stored. With more alternatives than anyone follows nothing is known: false.
  bool finds(int x, int y, const Stored& stored, HalfMode mode);
  /// After that, of the nearest alternative: whether a value is outside, and its codes.
  bool is_beyond(std::size_t value) const { return outside_[value] != 0; }
  const enclosed::CodeRange& codes(std::size_t value) const { return codes_[value]; }

 private:
  /// By the formula as written. Else sets what is outside of the nearest.
  bool is_held(const Stored& stored, HalfMode mode);
  /// By a rearrangement that usefully bounds what is outside: as everywhere in the second tier.
  bool is_held_rearranged(const Stored& stored, HalfMode mode);

  const std::vector<Slot>& slots_;
  const capture::PassModel& model_;
  const enclosed::Profile &profile_, &coarsest_;
  Alternatives all_;
  std::vector<char> outside_;
  std::vector<enclosed::CodeRange> codes_, ranges_;
};

}  // namespace rainref::judge
