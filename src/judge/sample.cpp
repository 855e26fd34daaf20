#include "judge/sample.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/hash.h"
#include "random/counter.h"

namespace rainref::judge {

std::int64_t sample_of_run(std::int64_t least, std::int64_t invocations, std::int64_t of) {
  if (least <= 0 || of <= least) return 0;
  const std::int64_t fewest = std::min<std::int64_t>(1024, least);  // 1024 invocations have a margin of 1/8
  const double share = static_cast<double>(least) * static_cast<double>(invocations) / static_cast<double>(of);
  return std::max(fewest, static_cast<std::int64_t>(std::ceil(share)));
}

Sample::Sample(const capture::PassCase& c, const capture::PassModel& model, std::int64_t least)
    : width_(model.width()), count_(static_cast<std::int64_t>(model.width()) * model.height()) {
  if (least <= 0 || count_ / least <= 1) return;
  stride_ = count_ / least;
  Hasher hasher(0);
  hasher.add(c.folder());
  hasher.add(c.uniforms);
  for (const capture::CaseOutput& o : c.outputs)
    for (const std::vector<std::byte>& level : o.array.levels) hasher.add(level);
  seed_ = hasher.finish().low;
}

std::int64_t Sample::drawn(std::int64_t stratum) const {
  const auto words = [](std::uint64_t x) { return std::pair(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(x >> 32)); };
  const auto [seed_low, seed_high] = words(seed_);
  const auto [low, high] = words(static_cast<std::uint64_t>(stratum));
  const std::uint64_t word = random::pcg4d({seed_low, seed_high, low, high})[0];
  return stratum * stride_ + static_cast<std::int64_t>(word * static_cast<std::uint64_t>(stride_) >> 32);
}

double Sample::margin(double values) const {
  if (is_whole()) return 0;
  // Each stratum contributes 0 to stride x values, independently: the probability of an error t is at most exp(-2 t^2 / (n (stride
  // values)^2)).
  const double strata = std::ceil(static_cast<double>(count_) / static_cast<double>(stride_)), chance = 40 * 0.693147180559945;
  return static_cast<double>(stride_) * values * std::sqrt(strata * chance / 2);
}

}  // namespace rainref::judge
