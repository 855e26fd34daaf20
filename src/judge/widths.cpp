#include "judge/widths.h"

#include <algorithm>

namespace rainref::judge {

void Widths::add(const enclosed::CodeRange& range) {
  constexpr double none = 4e9;
  const double codes = range.is_vacuous() ? none : static_cast<double>(range.hi) - static_cast<double>(range.lo);
  codes_.push_back(static_cast<std::uint32_t>(std::min(codes, none)));
}

void Widths::append(const Widths& more) { codes_.insert(codes_.end(), more.codes_.begin(), more.codes_.end()); }

void Widths::summarize(double& median, double& p99) {
  if (codes_.empty()) return;
  const auto at = [&](double share) {
    const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(codes_.size() - 1));
    std::nth_element(codes_.begin(), codes_.begin() + k, codes_.end());
    return static_cast<double>(codes_[static_cast<std::size_t>(k)]);
  };
  median = at(0.5);
  p99 = at(0.99);
}

}  // namespace rainref::judge
