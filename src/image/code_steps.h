// 8-bit codes of numbers in [0, 1] by table: a display function that never falls is known by the smallest number of each code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace rainref {

class CodeSteps {
 public:
  /// What a bucket of numbers has: the code of its smallest one, and from `step` on one more.
  struct Bucket {
    float step;
    std::int32_t code;
  };
  /// Buckets: the floats below 2^-12 (1 + 1/128), and from there 128 to an octave.
  static constexpr int shift = 23 - 7, buckets = 12 * 128 + 1;
  static constexpr std::int32_t first = (127 - 12) << 7;  ///< bits >> shift of the first bucket

  /// codes(x, code, count): the codes of count numbers.
  using Codes = std::function<void(const float* x, std::uint8_t* code, int count)>;

  CodeSteps() = default;
  /// Of a function that never falls and is 0 at 0.
  explicit CodeSteps(const Codes& codes);

  /// A bucket has room for one step: where the function climbs faster there is no table.
  bool empty() const { return buckets_.empty(); }
  /// The bucket of x > 0, x <= 1, is number max(bits of x >> shift, first) - first.
  const Bucket* data() const { return buckets_.data(); }
  std::size_t bytes() const { return buckets_.size() * sizeof(Bucket); }

 private:
  std::vector<Bucket> buckets_;
};

}  // namespace rainref
