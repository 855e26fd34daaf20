// Judges single invocations.
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
  as_written,  ///< by an alternative of the formula as written, or there were too many
  rearranged,  ///< by a rearrangement that the profile allows
  no
};
/// Tests whether some alternative accepts the stored values of an invocation. The arguments must outlive it. Thread-safe.
class InvocationJudge {
 public:
  /// `asks_again`: many ports are tested on the same few invocations. The allowed results of an invocation are then kept, unless they
  /// depend on the stored values.
  InvocationJudge(const capture::PassCase& c, const capture::PassModel& model, const enclosed::Profile& profile, HalfMode mode,
                  bool asks_again = false);
  /// `port` as in judge_case, `kept` as in JudgeOptions.
  Accepted accepts(int x, int y, const std::vector<capture::Array>& port, const port_dump::KeptForms* kept = nullptr) const;
  /// For each value, true if it is outside the alternative that holds most of them.
  std::vector<char> outside(int x, int y, const std::vector<capture::Array>& port, const port_dump::KeptForms* kept = nullptr) const;

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
