#include "math/large_angle.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "math/coefficients.h"

namespace rainref {

// x = m 2^e with a 53-bit integer m. The bits of 2/pi above weight 2^(2-e) add multiples of four quarter turns, and those below weight
// 2^(-158-e) add less than 2^-105. The 160 bits between them, times m, modulo 2^160, are the quarter turns with 158 bits after the point.
// No float is nearer to a multiple of pi/2 than 2^-30, so enough bits remain.
ReducedAngle reduce_large_angle(double x) {
  constexpr int window_words = 5;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const int e = std::min(static_cast<int>(bits >> 52) - 1075, 75);
  const std::uint64_t m = (bits & 0x000fffffffffffffu) | 0x0010000000000000u;
  const std::uint64_t m_low = m & 0xffffffffu, m_high = m >> 32;

  // The bit of 2/pi with weight 2^-i is bit number i + 31 of the table; the window starts at weight 2^(1-e).
  const int first = e + 30, word = first >> 5, shift = first & 31;
  std::uint32_t product[window_words] = {};  // most significant word first
  std::uint64_t carry_low = 0, carry_high = 0;
  std::uint64_t previous = 0;  // the window word one place below
  for (int i = window_words - 1; i >= 0; --i) {
    const std::uint64_t pair = std::uint64_t{coefficients::two_over_pi_bits[word + i]} << 32 | coefficients::two_over_pi_bits[word + i + 1];
    const std::uint64_t window = (pair << shift) >> 32;
    const std::uint64_t low = m_low * window + carry_low;
    const std::uint64_t sum = m_high * previous + (low & 0xffffffffu) + carry_high;
    product[i] = static_cast<std::uint32_t>(sum);
    carry_low = low >> 32;
    carry_high = sum >> 32;
    previous = window;
  }

  // Nearest whole number of quarter turns from the top two bits; the remainder is a signed fraction of 128 bits.
  const std::uint64_t top = std::uint64_t{product[0]} << 32 | product[1];
  const std::uint64_t middle = std::uint64_t{product[2]} << 32 | product[3];
  const std::uint64_t turns = (top + (std::uint64_t{1} << 61)) >> 62;
  const std::int64_t high = static_cast<std::int64_t>(top << 2 | middle >> 62);
  const std::uint64_t low = middle << 2 | product[4] >> 30;
  const double fraction = static_cast<double>(high) * 0x1p-64 + static_cast<double>(low) * 0x1p-128;
  return {static_cast<double>(turns), fraction * coefficients::half_pi};
}

void reduce_large_angles(const double* x, double* turns, double* rest, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!(x[i] > largest_small_angle)) continue;
    const ReducedAngle reduced = reduce_large_angle(x[i]);
    turns[i] = reduced.turns;
    rest[i] = reduced.rest;
  }
}

}  // namespace rainref
