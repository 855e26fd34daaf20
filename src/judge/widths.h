// How wide the envelopes of an output are, quantity by quantity, in codes and in the quantity's unit.
#pragma once

#include <cstdint>
#include <vector>

#include "image/code_range.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// Codes accepted besides the first; of a vacuous range 4e9.
std::uint32_t width_of(const enclosed::CodeRange& range);
/// What this share of the widths stays below; 0 of none. Reorders them.
double quantile(std::vector<std::uint32_t>& widths, double share);

/// Counts the elements of each quantity, and the width of each envelope: codes accepted besides the first, of which a vacuous
/// one counts as 4e9; and the extent of its values.
class Widths {
 public:
  void add(int quantity, const enclosed::CodeRange& range, double width, bool is_vacuous, bool is_loose);
  /// An element with too many alternatives to bound.
  void add_unbounded(int quantity);
  /// So many beside the sample, whose widths do not count.
  void add_unsampled(int quantity, std::int64_t count = 1);
  /// So many that no bound is asked for.
  void add_free(int quantity, std::int64_t count = 1);
  /// One that was counted already is outside, by so much in its unit.
  void add_failing(int quantity, double distance);
  void append(const Widths& more);
  /// The median and what 99 % stay below, of all and of each quantity, whose names are left alone; nothing where there are
  /// none.
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
