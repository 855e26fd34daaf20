// Sweeps the conversion to binary16 over all 2^32 floats: the integer rule against the processor's own conversion
// (F16C), and the lanes of every SIMD target and what they store against the integer rule, to nearest and toward zero.
// Some minutes; not part of the default tests.
//
//   half_full [--stride N]
//
// Exits with 1 if some code differs. The lanes are given finite floats only, as in every kernel.
#include <fmt/format.h>

#include <bit>
#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "math/half.h"
#include "math/half_array.h"
#include "math/half_hardware.h"
#include "math/lanes_kernels.h"
#include "math/simd_target.h"

namespace rainref::test {
namespace {

constexpr std::size_t block_size = 1 << 16;

struct Tally {
  std::uint64_t checked = 0, different = 0;
  double seconds = 0;
  std::string example;
  void differs(float x, unsigned got, unsigned expected) {
    if (different++ == 0) example = fmt::format("{:a}: {:#06x}, expected {:#06x}", x, got, expected);
  }
};

class Timer {
 public:
  explicit Timer(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  ~Timer() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

int run(int argc, char** argv) {
  std::uint64_t stride = 1;
  if (argc == 3 && std::string_view(argv[1]) == "--stride" && std::atoll(argv[2]) > 0) {
    stride = static_cast<std::uint64_t>(std::atoll(argv[2]));
  } else if (argc != 1) {
    fmt::print(stderr, "half_full [--stride N]\n");
    return 2;
  }
  const std::vector<std::string> targets = simd_targets();
  std::map<std::string, Tally> tallies;
  double rule_seconds = 0;
  std::vector<float> x(block_size), finite(block_size);
  std::vector<Half> rule(block_size), lanes(block_size);
  std::vector<std::uint16_t> hardware(block_size);
  for (std::uint64_t first = 0; first < std::uint64_t{1} << 32; first += block_size * stride) {
    for (std::size_t i = 0; i < block_size; ++i) {
      const auto bits = static_cast<std::uint32_t>(first + i * stride);
      x[i] = std::bit_cast<float>(bits);
      finite[i] = (bits & 0x7f800000u) == 0x7f800000u ? 1.0f : x[i];
    }
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      {
        const Timer timer(rule_seconds);
        for (std::size_t i = 0; i < block_size; ++i) rule[i] = to_half(x[i], rounding);
      }
      if (has_half_hardware()) {
        Tally& tally = tallies[fmt::format("rule against F16C, {}", name(rounding))];
        const Timer timer(tally.seconds);
        to_half_by_hardware(x.data(), hardware.data(), block_size, rounding);
        for (std::size_t i = 0; i < block_size; ++i) {
          if (!same_half(rule[i].bits, hardware[i])) tally.differs(x[i], rule[i].bits, hardware[i]);
        }
        tally.checked += block_size;
      }
      for (std::size_t i = 0; i < block_size; ++i) {
        if (std::bit_cast<std::uint32_t>(finite[i]) != std::bit_cast<std::uint32_t>(x[i])) rule[i] = {0x3c00};
        // The lanes store x + 0, so no half is -0 unless it is what a nonzero number rounds to.
        if (finite[i] == 0.0f) rule[i] = {0};
      }
      for (const std::string& target : targets) {
        Tally& tally = tallies[fmt::format("{} lanes against rule, {}", target, name(rounding))];
        const Timer timer(tally.seconds);
        select_simd_target(target);
        to_half_array(finite.data(), lanes.data(), block_size, rounding);
        for (std::size_t i = 0; i < block_size; ++i) {
          if (lanes[i].bits != rule[i].bits) tally.differs(finite[i], lanes[i].bits, rule[i].bits);
        }
        tally.checked += block_size;

        Tally& stores = tallies[fmt::format("{} stores against rule, {}", target, name(rounding))];
        const Timer of_stores(stores.seconds);
        const int count = lane_count();
        for (std::size_t i = 0; i < block_size; i += static_cast<std::size_t>(count))
          store_by_lanes(lanes.data() + i, finite.data() + i, rounding, count);
        for (std::size_t i = 0; i < block_size; ++i) {
          const std::uint16_t expected = rule[i].bits == 0x8000 ? 0 : rule[i].bits;  // nothing stored is -0
          if (lanes[i].bits != expected) stores.differs(finite[i], lanes[i].bits, expected);
        }
        stores.checked += block_size;
      }
    }
  }
  bool good = true;
  fmt::print("{:36} {:.1f} s\n", "integer rule, both roundings", rule_seconds);
  for (const auto& [what, tally] : tallies) {
    fmt::print("{:36} {} of {} differ, {:.1f} s\n", what, tally.different, tally.checked, tally.seconds);
    if (tally.different) fmt::print("    first {}\n", tally.example);
    good &= tally.different == 0;
  }
  if (!has_half_hardware()) fmt::print("this processor has no F16C: the rule itself was not checked\n");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace rainref::test

int main(int argc, char** argv) { return rainref::test::run(argc, argv); }
