// Fails values that a profile does not bound, but that no device computes.
//
// If a profile promises nothing about an operation, it formally allows any stored value, and any outcome of a comparison with the result.
// But rounding cannot explain a value that also lies outside the profile `coarsest`, in every alternative and every allowed rearrangement.
// Conforming and known devices lie inside it, so one such element would be enough. Still a share of the elements is required, because a few
// may have another reason, and a porting mistake makes many.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/alternatives.h"
#include "judge/stored.h"

namespace rainref::judge {

inline constexpr double gross_share = 0.005;
/// A few texels around one comparison are not enough.
inline constexpr std::int64_t least_gross = 16;

/// True if enough of the elements that the profile leaves open fail: OutputJudgement::beyond and open.
inline bool is_gross(std::int64_t beyond, std::int64_t open) {
  return beyond >= least_gross && static_cast<double>(beyond) > gross_share * static_cast<double>(open);
}

/// Tests one invocation after the other. The arguments must outlive it.
class Beyond {
 public:
  Beyond(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile);

  /// True if no alternative of `coarsest` holds all stored values. False if there are too many alternatives to follow.
  bool finds(int x, int y, const Stored& stored, HalfMode mode);
  /// After finds(), for the nearest alternative: true if a value is outside, and its codes.
  bool is_beyond(std::size_t value) const { return outside_[value] != 0; }
  const enclosed::CodeRange& codes(std::size_t value) const { return codes_[value]; }

 private:
  /// Tests the formula as written. If it fails, sets the values outside the nearest alternative.
  bool is_held(const Stored& stored, HalfMode mode);
  /// Tests the rearrangements that usefully bound the outside values, as in the second tier.
  bool is_held_rearranged(const Stored& stored, HalfMode mode);

  const std::vector<Slot>& slots_;
  const capture::PassModel& model_;
  const enclosed::Profile &profile_, &coarsest_;
  Alternatives all_;
  std::vector<char> outside_;
  std::vector<enclosed::CodeRange> codes_, ranges_;
};

}  // namespace rainref::judge
