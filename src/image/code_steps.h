// 8-bit codes of numbers in [0, 1] by table. A non-decreasing display function is defined by the smallest number of each code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace rainref {

class CodeSteps {
 public:
  /// A bucket of numbers: the code of its smallest number, and one more from `step` on.
  struct Bucket {
    float step;
    std::int32_t code;
  };
  /// Buckets: the floats below 2^-12 (1 + 1/128), then 128 per octave.
  static constexpr int shift = 23 - 7, buckets = 12 * 128 + 1;
  static constexpr std::int32_t first = (127 - 12) << 7;  ///< bits >> shift of the first bucket

  /// codes(x, code, count) computes the codes of count numbers.
  using Codes = std::function<void(const float* x, std::uint8_t* code, int count)>;

  CodeSteps() = default;
  /// For a non-decreasing function that is 0 at 0.
  explicit CodeSteps(const Codes& codes);

  /// True if there is no table: a bucket holds one step, and the function climbs faster somewhere.
  bool empty() const { return buckets_.empty(); }
  /// For x in (0, 1] the bucket has number max(bits of x >> shift, first) - first.
  const Bucket* data() const { return buckets_.data(); }
  std::size_t bytes() const { return buckets_.size() * sizeof(Bucket); }

 private:
  std::vector<Bucket> buckets_;
};

}  // namespace rainref
