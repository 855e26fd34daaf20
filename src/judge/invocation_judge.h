// Invocation by invocation, for those who ask about a few.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "capture/pass_model.h"
#include "judge/alternatives.h"
#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

enum class Accepted : std::uint8_t {
  as_written,  ///< by an alternative of the formula as it stands, or there were too many
  rearranged,  ///< by a rearrangement that the profile allows
  no
};
/// Whether some alternative accepts what is stored for an invocation. What it is made of must outlive it. Any thread may ask.
class InvocationJudge {
 public:
  /// `asks_again`: of many ports about the same few invocations. What the profile allows for one is then found once and kept, unless that
  /// hangs on what is stored.
  InvocationJudge(const capture::PassCase& c, const capture::PassModel& model, const enclosed::Profile& profile, HalfMode mode,
                  bool asks_again = false);
  /// `port` as in judge_case.
  Accepted accepts(int x, int y, const std::vector<capture::Array>& port) const;
  /// Of each value whether it is outside the alternative that holds most of them.
  std::vector<char> outside(int x, int y, const std::vector<capture::Array>& port) const;

 private:
  struct Known {
    std::once_flag is_written_known, is_rearranged_known;
    Alternatives written, rearranged;
  };
  Known& known(int x, int y) const;

  const capture::PassCase& case_;
  const capture::PassModel& model_;
  const enclosed::Profile& profile_;
  HalfMode mode_;
  bool keeps_;
  mutable std::mutex mutex_;
  mutable std::map<std::array<int, 2>, std::unique_ptr<Known>> known_;  // by texel
};

}  // namespace rainref::judge
