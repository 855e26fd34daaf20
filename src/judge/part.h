// The counts that result when some invocations of a case are judged by envelope, and the sum of such counts.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/pass_case.h"
#include "judge/verdict.h"
#include "judge/widths.h"

namespace rainref::judge {

/// Counts under one rounding of half stores.
struct Part {
  /// In OutputJudgement::map until settle_beyond(): the profile has no bound, and the value is outside what the coarsest device may do.
  static constexpr std::uint8_t beyond_mark = 5;

  /// All counts 0.
  explicit Part(const capture::PassCase& c);
  /// Adds everything but the maps.
  void add(const Part& other);

  /// True if a large share of the elements that the profile leaves open is beyond every device.
  bool is_gross() const;
  /// The same if all elements that were not tested were open.
  bool may_be_gross() const;
  /// Makes elements beyond every device fail if there are many; else they stay a warning.
  void settle_beyond();
  /// Sets the widths of the outputs.
  void summarize();

  /// Counts that become failures only if there are many.
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
