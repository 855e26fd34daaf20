// Every result that a profile allows for an invocation, and the codes that a device stores for it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "capture/pass_model.h"
#include "image/code_range.h"
#include "judge/slots.h"
#include "judge/verdict.h"
#include "math/enclosure.h"
#include "math/path_enumeration.h"
#include "math/profile.h"

namespace rainref::judge {

/// How a device stores that the profile allows and that rounds its halves by `mode`; `unorm`: the reference's own way.
enclosed::StoreRules rules_of(const enclosed::Profile& profile, HalfMode mode, Rounding unorm);
/// The profile of a device whose stores round like this.
enclosed::Profile narrowed(const enclosed::Profile& profile, HalfMode mode);

/// Every alternative of an invocation.
struct Alternatives {
  std::array<std::vector<enclosed::Enclosure>, enclosed::PathEnumeration::max_runs> values;
  int count = 0;
  bool gave_up = false;

  /// What the reference stored, and nothing else.
  void only(const std::vector<float>& expected);
  /// What the profile allows. `port`: what the port stored for the invocation.
  void run(const capture::PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile);
  /// A part of these that the pass finds sooner (PassModel::enclose_part); none where it has no such part.
  void run_part(const capture::PassModel& model, int part, int x, int y, const float* port, const enclosed::Profile& profile);
  /// What the rearrangements give that it allows; nothing, as if given up, where the pass has no evaluation for them.
  void rearrange(const capture::PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile);
};

/// The codes of one alternative under one rounding, into `out`.
void code_ranges(const std::vector<Slot>& slots, const std::vector<enclosed::Enclosure>& values, const enclosed::Profile& profile,
                 HalfMode mode, std::vector<enclosed::CodeRange>& out);

/// Whether a bound says little of a value, or less than it should.
struct Bound {
  bool vacuous, loose;
};
Bound bound_of(const Slot& slot, const enclosed::Enclosure& value, const enclosed::CodeRange& codes);

/// Codes between a code and a range; 0 inside.
std::uint64_t distance(std::int64_t code, const enclosed::CodeRange& range);

}  // namespace rainref::judge
