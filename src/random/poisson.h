// Poisson counts from a table of integer thresholds. The host computes the table; drawing from it is exact.
#pragma once

#include <cstdint>
#include <vector>

namespace rainref::random {

/// Draws N with P(N <= k) = thresholds[k - first] / 2^32, from one random word by comparisons only.
class PoissonTable {
 public:
  static constexpr double max_mean = 4000;

  PoissonTable() = default;
  /// mean in [0, max_mean]; otherwise throws Error(usage). Probabilities below 2^-32 are cut off.
  explicit PoissonTable(double mean);

  /// The count for this random word.
  int count(std::uint32_t word) const;
  int largest() const { return first_ + static_cast<int>(thresholds_.size()); }
  int first() const { return first_; }
  const std::vector<std::uint32_t>& thresholds() const { return thresholds_; }

 private:
  int first_ = 0;                          // smaller counts have no weight
  std::vector<std::uint32_t> thresholds_;  // non-decreasing; a word at or above the last one draws largest()
};

}  // namespace rainref::random
