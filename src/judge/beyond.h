// What a profile leaves without a bound, and no device comes to.
//
// A vacuous element may hold anything by the profile's letter. What lies outside the profile `coarsest` too, in every alternative and every
// rearrangement that the profile allows, is explained by no rounding: that is the distance. A comparison that a still coarser device tips
// makes a few such elements, so a share of them is asked for before they fail.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/alternatives.h"
#include "judge/stored.h"

namespace rainref::judge {

/// A sine twice as coarse as the coarsest tips less than one comparison in five hundred of the small packs (tests/judge/beyond_test.cpp).
inline constexpr double gross_share = 0.01;
/// A few texels around one comparison are no share of anything.
inline constexpr std::int64_t least_gross = 16;

/// Whether so many elements, of all that have no bound, fail.
inline bool is_gross(std::int64_t beyond, std::int64_t vacuous) {
  return beyond >= least_gross && static_cast<double>(beyond) > gross_share * static_cast<double>(vacuous);
}

/// Asks it of one invocation after the other. What it refers to must outlive it.
class Beyond {
 public:
  Beyond(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile);

  /// Whether no alternative of `coarsest` holds all values that are `vacuous`. What is not known of all alternatives counts as held.
  bool finds(int x, int y, const Stored& stored, const std::vector<char>& vacuous, HalfMode mode);
  /// After that, of the nearest alternative: whether a value is outside, and its codes.
  bool is_beyond(std::size_t value) const { return outside_[value] != 0; }
  const enclosed::CodeRange& codes(std::size_t value) const { return codes_[value]; }

 private:
  bool none_holds(const Stored& stored, const std::vector<char>& vacuous, HalfMode mode);

  const std::vector<Slot>& slots_;
  const capture::PassModel& model_;
  const enclosed::Profile &profile_, &coarsest_;
  Alternatives all_;
  std::size_t fewest_ = 0;
  std::vector<char> outside_, tried_;
  std::vector<enclosed::CodeRange> codes_, tried_codes_;
};

}  // namespace rainref::judge
