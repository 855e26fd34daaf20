// Every float of the domain of cube_root in lanes, on the best SIMD target and on the last: the bits of pow. A minute; run by hand.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "math/lanes_kernels.h"
#include "math/real64.h"
#include "math/simd_target.h"

int main() {
  using namespace rainref;
  constexpr std::uint32_t first = 0x33800000, end = 0x4d800000, block = 1 << 16;  // 2^-24 to 2^28
  constexpr float third = 1.0f / 3.0f;
  const std::vector<std::string> targets = simd_targets();
  std::vector<float> x(block), root(block), power(block);
  std::uint64_t different = 0;
  for (std::uint32_t bits = first; bits < end; bits += block) {
    for (std::uint32_t i = 0; i < block; ++i) {
      x[i] = std::bit_cast<float>(bits + i);
      power[i] = pow_float(x[i], third);
    }
    for (const std::string& target : {targets.front(), targets.back()}) {
      select_simd_target(target);
      test::apply_by_lanes(test::Operation::cube_root_any, x.data(), x.data(), x.data(), root.data(), block);
      for (std::uint32_t i = 0; i < block; ++i) {
        if (std::bit_cast<std::uint32_t>(root[i]) == std::bit_cast<std::uint32_t>(power[i])) continue;
        if (different++ < 10) fmt::print("{}: cube_root({:a}) = {:a}, pow {:a}\n", target, x[i], root[i], power[i]);
      }
    }
  }
  fmt::print("{} floats on {} and {}: {} differ\n", end - first, targets.front(), targets.back(), different);
  return different == 0 ? 0 : 1;
}
