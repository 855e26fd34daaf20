// All results that a profile allows for an invocation, and the codes that a device stores for them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "capture/pass_model.h"
#include "image/code_range.h"
#include "judge/slots.h"
#include "judge/stored.h"
#include "judge/verdict.h"
#include "math/enclosure.h"
#include "math/path_enumeration.h"
#include "math/profile.h"

namespace rainref::judge {

/// Store rules of a device that the profile allows and that rounds halves by `mode`; `unorm`: the reference's own rounding.
enclosed::StoreRules rules_of(const enclosed::Profile& profile, HalfMode mode, Rounding unorm);
/// The profile of a device whose stores round halves by `mode`.
enclosed::Profile narrowed(const enclosed::Profile& profile, HalfMode mode);

/// All alternatives of an invocation.
struct Alternatives {
  std::array<std::vector<enclosed::Enclosure>, enclosed::PathEnumeration::max_runs> values;
  int count = 0;
  bool gave_up = false;

  /// Sets the reference's stored values as the only alternative, wider as by run().
  void only(const Stored& stored);
  /// Evaluates all results that the profile allows. `port`: what the port stored for the invocation.
  void run(const capture::PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile);
  /// The same, wider by what a port's own form of its buffers leaves open: an alternative holds the stored value if it holds one of those
  /// that the port may have had.
  void run(const capture::PassModel& model, int x, int y, const Stored& stored, const enclosed::Profile& profile);
  /// Evaluates a part of these that the pass finds faster (PassModel::enclose_part); no alternative if it has no such part.
  void run_part(const capture::PassModel& model, int part, int x, int y, const Stored& stored, const enclosed::Profile& profile);
  /// Evaluates the rearrangements that the profile allows. If the pass has no evaluation for them: no alternative, as if given up.
  void rearrange(const capture::PassModel& model, int x, int y, const float* port, const enclosed::Profile& profile);
  void rearrange(const capture::PassModel& model, int x, int y, const Stored& stored, const enclosed::Profile& profile);

 private:
  void widen(const Stored& stored);
};

/// Writes the codes of one alternative under one rounding to `out`.
void code_ranges(const std::vector<Slot>& slots, const std::vector<enclosed::Enclosure>& values, const enclosed::Profile& profile,
                 HalfMode mode, std::vector<enclosed::CodeRange>& out);

/// True if a bound is too wide to be useful, or wider than it should be.
struct Bound {
  bool vacuous, loose;
};
Bound bound_of(const Slot& slot, const enclosed::Enclosure& value, const enclosed::CodeRange& codes);

/// Distance between a code and a range, in codes; 0 inside.
std::uint64_t distance(std::int64_t code, const enclosed::CodeRange& range);

}  // namespace rainref::judge
