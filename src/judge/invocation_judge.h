// Invocation by invocation, for those who ask about a few.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/pass_model.h"
#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

enum class Accepted : std::uint8_t {
  as_written,  ///< by an alternative of the formula as it stands, or there were too many
  rearranged,  ///< by a rearrangement that the profile allows
  no
};
/// Whether some alternative accepts what is stored for an invocation. What it is made of must outlive it.
class InvocationJudge {
 public:
  InvocationJudge(const capture::PassCase& c, const capture::PassModel& model, const enclosed::Profile& profile, HalfMode mode);
  /// `port` as in judge_case.
  Accepted accepts(int x, int y, const std::vector<capture::Array>& port) const;
  /// Of each value whether it is outside the alternative that holds most of them.
  std::vector<char> outside(int x, int y, const std::vector<capture::Array>& port) const;

 private:
  const capture::PassCase& case_;
  const capture::PassModel& model_;
  const enclosed::Profile& profile_;
  HalfMode mode_;
};

}  // namespace rainref::judge
