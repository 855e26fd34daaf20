// How wide the envelopes of an output are, in codes.
#pragma once

#include <cstdint>
#include <vector>

#include "image/code_range.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// The width of each envelope: codes accepted besides the first. A vacuous one counts as 4e9.
class Widths {
 public:
  void add(const enclosed::CodeRange& range);
  void append(const Widths& more);
  /// The median and what 99 % stay below; leaves both as they are where there are none.
  void summarize(double& median, double& p99);

 private:
  std::vector<std::uint32_t> codes_;
};

}  // namespace rainref::judge
