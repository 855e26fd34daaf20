// The widths of an output's envelopes for each quantity, in codes and in the quantity's unit.
#pragma once

#include <cstdint>
#include <vector>

#include "image/code_range.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// Number of accepted codes besides the first; 4e9 for a vacuous range.
std::uint32_t width_of(const enclosed::CodeRange& range);
/// The quantile of the widths at `share`; 0 if there are none. Reorders them.
double quantile(std::vector<std::uint32_t>& widths, double share);

/// Counts the elements of each quantity and their widths: accepted codes besides the first (4e9 if vacuous), and the extent of the values.
class Widths {
 public:
  void add(int quantity, const enclosed::CodeRange& range, double width, bool is_vacuous, bool is_loose);
  /// Adds an element with too many alternatives to bound.
  void add_unbounded(int quantity);
  /// Adds elements outside the sample, whose widths do not count.
  void add_unsampled(int quantity, std::int64_t count = 1);
  /// Adds elements that need no bound.
  void add_free(int quantity, std::int64_t count = 1);
  /// Adds the distance of an outside element that was already counted, in its unit.
  void add_failing(int quantity, double distance);
  void append(const Widths& more);
  /// Sets the median and the 99 % quantile, of all and of each quantity, and keeps the names; nothing if there are no widths.
  void summarize(OutputJudgement& out);

 private:
  struct Quantity {
    QuantityJudgement counts;
    std::vector<std::uint32_t> codes;
    std::vector<float> widths;
  };
  Quantity& at(int quantity);

  std::vector<Quantity> quantities_;
};

}  // namespace rainref::judge
