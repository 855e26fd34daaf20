// Sweeps the transcendental functions over all 2^32 floats: correct rounding against MPFR, and equal bits of the best
// SIMD target, the scalar target and plain C++. Minutes for each function; not part of the default tests.
//
//   transcendental_full [--function NAME] [--check accuracy|bits] [--stride N] [--threads N]
//
// Exits with 1 if some result is more than 1 ULP off, if more results than documented are not correctly rounded, or if
// some bit differs.
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "math/simd_target.h"
#include "math/transcendental_cases.h"

namespace rainref::test {
namespace {

constexpr std::size_t block_size = 1 << 16;

struct Options {
  std::string function, check;  // empty: all
  std::uint64_t stride = 1;
  int threads = 1;
};

struct Inputs {
  std::vector<float> a = std::vector<float>(block_size), b = std::vector<float>(block_size);
  void fill(const Case& c, std::uint64_t first, std::uint64_t stride) {
    for (std::size_t i = 0; i < block_size; ++i) {
      const auto bits = static_cast<std::uint32_t>(first + i * stride);
      a[i] = finite_from_bits(bits);
      b[i] = second_argument(c, bits);
    }
  }
};

/// Calls body(block, first index) for every block, on several threads; body is made once for each thread.
template <class MakeBody>
void for_blocks(const Options& options, MakeBody make_body) {
  const std::uint64_t step = block_size * options.stride;
  std::atomic<std::uint64_t> next{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < options.threads; ++t) {
    threads.emplace_back([&] {
      auto body = make_body();
      for (;;) {
        const std::uint64_t block = next.fetch_add(1);
        if (block * step >= std::uint64_t{1} << 32) return;
        body(block, block * step);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

std::size_t block_count(const Options& options) {
  const std::uint64_t step = block_size * options.stride;
  return static_cast<std::size_t>(((std::uint64_t{1} << 32) + step - 1) / step);
}

Hash128 hash_of(std::span<const float> values) {
  Hasher hasher;
  hasher.add(std::as_bytes(values));
  return hasher.finish();
}

/// One hash for each block on the target in use.
std::vector<Hash128> hash_blocks(const Case& c, const Options& options) {
  std::vector<Hash128> hashes(block_count(options));
  for_blocks(options, [&] {
    return [&, in = Inputs(), out = std::vector<float>(block_size)](std::uint64_t block, std::uint64_t first) mutable {
      in.fill(c, first, options.stride);
      run_lanes(c.function, in.a, in.b, out.data());
      hashes[block] = hash_of(out);
    };
  });
  return hashes;
}

std::vector<Hash128> hash_blocks_plain(const Case& c, const Options& options) {
  std::vector<Hash128> hashes(block_count(options));
  for_blocks(options, [&] {
    return [&, in = Inputs(), out = std::vector<float>(block_size)](std::uint64_t block, std::uint64_t first) mutable {
      in.fill(c, first, options.stride);
      for (std::size_t i = 0; i < block_size; ++i) out[i] = implementation(c.function).plain(in.a[i], in.b[i]);
      hashes[block] = hash_of(out);
    };
  });
  return hashes;
}

struct Accuracy {
  std::uint64_t not_nearest = 0;
  double worst_ulp = 0.5;
  std::vector<std::string> examples;
};

Accuracy measure(const Case& c, const Options& options) {
  Accuracy accuracy;
  std::mutex mutex;
  for_blocks(options, [&] {
    return [&, in = Inputs(), out = std::vector<float>(block_size), oracle = std::make_unique<MpfrOracle>()](std::uint64_t,
                                                                                                             std::uint64_t first) mutable {
      in.fill(c, first, options.stride);
      run_lanes(c.function, in.a, in.b, out.data());
      for (std::size_t i = 0; i < block_size; ++i) {
        const float reference = oracle->nearest_quickly(c.function, in.a[i], in.b[i]);
        if (std::bit_cast<std::uint32_t>(reference) == std::bit_cast<std::uint32_t>(out[i])) continue;
        // A zero of the wrong sign is no distance away, but no pardon either.
        const double error = reference == out[i] ? 2.0 : oracle->error_in_ulp(c.function, in.a[i], in.b[i], out[i]);
        const std::lock_guard lock(mutex);
        ++accuracy.not_nearest;
        accuracy.worst_ulp = std::max(accuracy.worst_ulp, error);
        if (accuracy.examples.size() < 40) {
          accuracy.examples.push_back(
              fmt::format("f({:a}, {:a}) = {:a}, correct {:a}, {:.9f} ULP", in.a[i], in.b[i], out[i], reference, error));
        }
      }
    };
  });
  return accuracy;
}

template <class F>
auto timed(double& seconds, F f) {
  const auto start = std::chrono::steady_clock::now();
  auto result = f();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

/// Whether every result is as near as documented.
bool check_accuracy(const Case& c, const Options& options) {
  double seconds = 0;
  const Accuracy accuracy = timed(seconds, [&] { return measure(c, options); });
  fmt::print("{:13} accuracy: {} not nearest (documented {}), at most {:.9f} ULP, {:.0f} s\n", c.name, accuracy.not_nearest, c.not_nearest,
             accuracy.worst_ulp, seconds);
  for (const std::string& example : accuracy.examples) fmt::print("    {}\n", example);
  return accuracy.not_nearest <= c.not_nearest && accuracy.worst_ulp <= 1;
}

/// Whether the best target, the scalar target and plain C++ give the same bits.
bool check_bits(const Case& c, const Options& options) {
  double best_s = 0, scalar_s = 0, plain_s = 0;
  const std::vector<std::string> targets = simd_targets();  // best first, scalar last
  const auto best = timed(best_s, [&] { return hash_blocks(c, options); });
  select_simd_target(targets.back());
  const auto scalar = timed(scalar_s, [&] { return hash_blocks(c, options); });
  select_simd_target("");
  const auto plain = timed(plain_s, [&] { return hash_blocks_plain(c, options); });

  Hasher all;
  for (const Hash128& hash : best) all.add(hash.text());
  const bool equal = best == scalar && best == plain;
  fmt::print("{:13} bits: {}, hash {}, {} {:.0f} s, {} {:.0f} s, plain {:.0f} s\n", c.name, equal ? "equal" : "DIFFER", all.finish().text(),
             targets.front(), best_s, targets.back(), scalar_s, plain_s);
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i] == scalar[i] && best[i] == plain[i]) continue;
    fmt::print("    first difference in block {} of {} floats, stride {}\n", i, block_size, options.stride);
    break;
  }
  return equal;
}

int run(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    const long long number = std::atoll(value.data());
    if (name == "--function" && !value.empty()) {
      options.function = value;
    } else if (name == "--check" && (value == "accuracy" || value == "bits")) {
      options.check = value;
    } else if (name == "--stride" && number > 0) {
      options.stride = static_cast<std::uint64_t>(number);
    } else if (name == "--threads" && number > 0 && number <= 1024) {
      options.threads = static_cast<int>(number);
    } else {
      fmt::print(stderr, "transcendental_full [--function F] [--check accuracy|bits] [--stride N] [--threads N]\n");
      return 2;
    }
  }
  bool good = true, found = false;
  for (const Case& c : cases) {
    if (!options.function.empty() && options.function != c.name) continue;
    found = true;
    if (options.check != "bits") good &= check_accuracy(c, options);
    if (options.check != "accuracy") good &= check_bits(c, options);
    std::fflush(stdout);
  }
  if (found) return good ? 0 : 1;
  fmt::print(stderr, "no function {}\n", options.function);
  return 2;
}

}  // namespace
}  // namespace rainref::test

int main(int argc, char** argv) { return rainref::test::run(argc, argv); }
