// What the judgement of some invocations of a case by envelope comes to, and the sum of such parts.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/pass_case.h"
#include "judge/verdict.h"
#include "judge/widths.h"

namespace rainref::judge {

/// Counts under one rounding of half stores.
struct Part {
  /// In OutputJudgement::map until settle_beyond(): outside what the coarsest device may do, where the profile bounds nothing.
  static constexpr std::uint8_t beyond_mark = 5;

  /// Of nothing.
  explicit Part(const capture::PassCase& c);
  /// Adds all but the maps.
  void add(const Part& other);

  /// Whether much of what the profile leaves open is beyond every device.
  bool is_gross() const;
  /// The same if all that was not asked were open.
  bool may_be_gross() const;
  /// Lets what is beyond every device fail where there is much of it; else it stays a warning.
  void settle_beyond();
  /// Gives the outputs their widths.
  void summarize();

  /// What fails only where there is much of it.
  struct Gross {
    std::vector<Failure> worst;
    Widths farthest;
  };
  CaseJudgement counts;
  std::vector<Widths> widths;                          ///< of each output
  std::vector<std::vector<std::uint32_t>> rearranged;  ///< of each output: widths of some invocations
  std::vector<Gross> beyond;                           ///< of each output
};

}  // namespace rainref::judge
