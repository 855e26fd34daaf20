// Statistics of random numbers. Every bound names its false-alarm rate; the seeds are fixed, so a test that passes
// once passes always.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace rainref::test {

/// Pearson's chi-square of counts that should be equal.
inline double chi_square(const std::vector<int>& counts) {
  double total = 0, sum = 0;
  for (const int n : counts) total += n;
  const double expected = total / static_cast<double>(counts.size());
  for (const int n : counts) sum += (n - expected) * (n - expected) / expected;
  return sum;
}
/// With 100 cells (99 degrees of freedom) a fair generator leaves this range once in 5000 times, half of it on each
/// side: below 54.9 it is too even, above 160.2 too uneven.
constexpr double chi_square_99_low = 54.9, chi_square_99_high = 160.2;

/// The cell of a point of the unit square in a 10 x 10 grid.
inline std::size_t cell_of(double x, double y) {
  return static_cast<std::size_t>(static_cast<int>(y * 10) * 10 + static_cast<int>(x * 10));
}

/// Correlation of each number with the next but `lag - 1`; its standard deviation is 1 / sqrt(n).
inline double lag_correlation(const std::vector<float>& x, std::size_t lag = 1) {
  double mean = 0, variance = 0, covariance = 0;
  for (const float v : x) mean += v / static_cast<double>(x.size());
  for (std::size_t i = 0; i + lag < x.size(); ++i) {
    variance += (x[i] - mean) * (x[i] - mean);
    covariance += (x[i] - mean) * (x[i + lag] - mean);
  }
  return covariance / variance;
}

}  // namespace rainref::test
