#include "random/poisson.h"

#include <algorithm>

#include <fmt/format.h>

#include "math/real64.h"
#include "rainref/error.h"
#include "random/words.h"

namespace rainref::random {
namespace {

// End of the table for this mean; larger counts have no weight.
int end_of(double mean) { return static_cast<int>(__builtin_ceil(mean + 12 * __builtin_sqrt(mean) + 40)); }
// Logarithms of 1, 2, ... are cached, because an accelerating car needs another table in each step.
const std::vector<double>& logarithms() {
  static const std::vector<double> logs = [] {
    std::vector<double> out{0};
    for (int k = 1; k < end_of(PoissonTable::max_mean); ++k) out.push_back(log_real(Real64(k)).v);
    return out;
  }();
  return logs;
}

}  // namespace

PoissonTable::PoissonTable(double mean) {
  if (!(mean >= 0 && mean <= max_mean)) {
    throw Error(ExitCode::usage, fmt::format("a Poisson mean of {}: expected a number from 0 to {}", mean, max_mean));
  }
  if (mean == 0) return;
  // Weights by logarithm, because e^-mean underflows beyond a mean of 745; then normalized, so that the rounding of the logarithms cancels.
  const double log_mean = log_real(Real64(mean)).v;
  double log_weight = -mean;
  std::vector<double> weights;
  for (int k = 0, end = end_of(mean); k < end; ++k) {
    if (k > 0) log_weight += log_mean - logarithms()[static_cast<std::size_t>(k)];
    weights.push_back(log_weight < -60 ? 0.0 : exp_real(Real64(log_weight)).v);
  }
  double total = 0;
  for (const double w : weights) total += w;
  double sum = 0;
  for (const double w : weights) {
    sum += w;
    const double scaled = sum / total * 0x1p32;
    if (scaled >= 0x1p32 - 1) break;
    thresholds_.push_back(static_cast<std::uint32_t>(scaled));
  }
  const auto some = std::find_if(thresholds_.begin(), thresholds_.end(), [](std::uint32_t t) { return t > 0; });
  first_ = static_cast<int>(some - thresholds_.begin());
  thresholds_.erase(thresholds_.begin(), some);
}

int PoissonTable::count(std::uint32_t word) const { return Words::count(word, first_, std::span<const std::uint32_t>(thresholds_)); }

}  // namespace rainref::random
