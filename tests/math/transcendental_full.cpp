// Sweeps the transcendental functions over all 2^32 floats: correct rounding against MPFR, and equal bits of the best
// SIMD target, the scalar target and plain C++. Minutes for each function; not part of the default tests.
//
//   transcendental_full [--function NAME] [--stride N] [--threads N]
//
// Exits with 1 if some result is more than 1 ULP off, if more results than documented are not correctly rounded, or if
// some bit differs.
#include <fmt/format.h>
#include <hwy/targets.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "math/transcendental_cases.h"

namespace rainref::test {
namespace {

constexpr std::size_t block_size = 1 << 16;

struct Options {
  std::string function;
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
      run_array(c.function, in.a, in.b, out.data());
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
      for (std::size_t i = 0; i < block_size; ++i) out[i] = run_float(c.function, in.a[i], in.b[i]);
      hashes[block] = hash_of(out);
    };
  });
  return hashes;
}

struct Accuracy {
  std::uint64_t not_nearest = 0;
  double worst_ulp = 0;
  std::vector<std::string> examples;
};

Accuracy measure(const Case& c, const Options& options) {
  Accuracy accuracy;
  std::mutex mutex;
  for_blocks(options, [&] {
    return [&, in = Inputs(), out = std::vector<float>(block_size), oracle = std::make_unique<MpfrOracle>()](
               std::uint64_t, std::uint64_t first) mutable {
      in.fill(c, first, options.stride);
      run_array(c.function, in.a, in.b, out.data());
      for (std::size_t i = 0; i < block_size; ++i) {
        const float reference = oracle->nearest_quickly(c.function, in.a[i], in.b[i]);
        if (std::bit_cast<std::uint32_t>(reference) == std::bit_cast<std::uint32_t>(out[i])) continue;
        // A zero of the wrong sign is no distance away, but no pardon either.
        const double error = reference == out[i] ? 2.0 : oracle->error_in_ulp(c.function, in.a[i], in.b[i], out[i]);
        const std::lock_guard lock(mutex);
        ++accuracy.not_nearest;
        accuracy.worst_ulp = std::max(accuracy.worst_ulp, error);
        if (accuracy.examples.size() < 8)
          accuracy.examples.push_back(
              fmt::format("f({:a}, {:a}) = {:a}, correct {:a}, {:.9f} ULP", in.a[i], in.b[i], out[i], reference, error));
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

/// Whether all is as documented.
bool sweep(const Case& c, const Options& options) {
  double accuracy_s = 0, best_s = 0, scalar_s = 0, plain_s = 0;
  const Accuracy accuracy = timed(accuracy_s, [&] { return measure(c, options); });
  const auto best = timed(best_s, [&] { return hash_blocks(c, options); });
  hwy::SetSupportedTargetsForTest(hwy::SupportedAndGeneratedTargets().back());  // best first, scalar last
  const auto scalar = timed(scalar_s, [&] { return hash_blocks(c, options); });
  hwy::SetSupportedTargetsForTest(0);
  const auto plain = timed(plain_s, [&] { return hash_blocks_plain(c, options); });

  Hasher all;
  for (const Hash128& hash : best) all.add(hash.text());
  const bool same_bits = best == scalar && best == plain;
  const bool accurate = accuracy.not_nearest <= c.not_nearest && accuracy.worst_ulp <= 1;
  fmt::print("{:13} not nearest {:3} (documented {}), worst {:.9f} ULP, {}, hash {}\n", c.name, accuracy.not_nearest,
             c.not_nearest, accuracy.not_nearest == 0 ? 0.5 : accuracy.worst_ulp,
             same_bits ? "bits equal" : "BITS DIFFER", all.finish().text());
  fmt::print("{:13} seconds: accuracy {:.0f}, best target {:.0f}, scalar target {:.0f}, plain {:.0f}\n", "", accuracy_s,
             best_s, scalar_s, plain_s);
  for (const std::string& example : accuracy.examples) fmt::print("    {}\n", example);
  if (!same_bits) {
    for (std::size_t i = 0; i < best.size(); ++i) {
      if (best[i] == scalar[i] && best[i] == plain[i]) continue;
      fmt::print("    first difference in block {} of {} floats, stride {}\n", i, block_size, options.stride);
      break;
    }
  }
  std::fflush(stdout);
  return same_bits && accurate;
}

int run(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--function")) options.function = argv[i + 1];
    else if (!std::strcmp(argv[i], "--stride")) options.stride = std::max(1ull, std::strtoull(argv[i + 1], nullptr, 10));
    else if (!std::strcmp(argv[i], "--threads")) options.threads = std::max(1, std::atoi(argv[i + 1]));
    else return fmt::print(stderr, "unknown option {}\n", argv[i]), 2;
  }
  if (argc % 2 == 0) return fmt::print(stderr, "usage: transcendental_full [--function F] [--stride N] [--threads N]\n"), 2;
  bool good = true, found = false;
  for (const Case& c : cases) {
    if (!options.function.empty() && options.function != c.name) continue;
    found = true;
    good &= sweep(c, options);
  }
  if (!found) return fmt::print(stderr, "no function {}\n", options.function), 2;
  return good ? 0 : 1;
}

}  // namespace
}  // namespace rainref::test

int main(int argc, char** argv) { return rainref::test::run(argc, argv); }
