// Measures a pack: which faults of the reference it would catch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "judge/validate.h"

namespace rainref::faults {

/// One fault on one pass of a pack.
struct MutantJudgement {
  std::string pass, name, sentence;
  bool legal = false;
  std::int64_t compared = 0;    ///< invocations, and ids of lists
  std::int64_t differing = 0;   ///< invocations whose stored bits differ from the reference
  std::int64_t outside = 0;     ///< invocations that no alternative accepts, neither of the formula as written nor of a rearrangement
  std::int64_t rearranged = 0;  ///< invocations that only a rearrangement accepts: a port with only these gets a warning
  bool caught() const { return outside > 0; }
  /// True if it is not caught, but a port with it would get a WARN.
  bool warned() const { return !caught() && rearranged > 0; }
};
struct MutationReport {
  std::string pack, profile;
  std::vector<MutantJudgement> mutants;
  std::vector<std::string> unjudged;  ///< passes that no envelope judges, and why
};
/// Finds the faults that the pack would catch under a profile. Compares at most `invocations` texels of each case, spread over the picture,
/// and every record of its lists.
MutationReport mutate(const capture::Pack& pack, const judge::ValidateOptions& options, int invocations = 4096);

}  // namespace rainref::faults
