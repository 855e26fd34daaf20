#include "image/code_steps.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace rainref {
namespace {

constexpr std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f);

}  // namespace

CodeSteps::CodeSteps(const Codes& codes) {
  // Nonnegative floats have the order of their bits.
  std::vector<std::uint32_t> ends(buckets + 1);
  for (int k = 0; k <= buckets; ++k) ends[static_cast<std::size_t>(k)] = k == 0 ? 0 : static_cast<std::uint32_t>(first + k) << shift;
  ends.back() = one + 1;
  std::vector<float> x(buckets + 1);
  std::vector<std::uint8_t> code(buckets + 1);
  const auto evaluate = [&] { codes(x.data(), code.data(), static_cast<int>(x.size())); };
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = std::bit_cast<float>(std::min(ends[k], one));
  evaluate();
  const std::vector<std::uint8_t> begin = code;
  if (begin[0] != 0) return;
  for (int k = 0; k < buckets; ++k)
    if (begin[static_cast<std::size_t>(k) + 1] - begin[static_cast<std::size_t>(k)] > 1) return;

  // The first number of each bucket whose code differs from that of its smallest one, or the bucket's end; all buckets side by side.
  std::vector<std::uint32_t> low(ends.begin(), ends.end() - 1), high(ends.begin() + 1, ends.end());
  const auto middle = [&](std::size_t k) { return low[k] + (high[k] - low[k]) / 2; };
  for (int round = 0; round < 32; ++round) {
    for (std::size_t k = 0; k < buckets; ++k) x[k] = std::bit_cast<float>(middle(k));
    evaluate();
    for (std::size_t k = 0; k < buckets; ++k) (code[k] > begin[k] ? high[k] : low[k]) = middle(k);
  }
  buckets_.resize(buckets);
  for (std::size_t k = 0; k < buckets; ++k)
    buckets_[k] = {high[k] == ends[k + 1] ? std::numeric_limits<float>::infinity() : std::bit_cast<float>(high[k]), begin[k]};
}

}  // namespace rainref
