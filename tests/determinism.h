// The proof of determinism that the effects share: every SIMD target, number of threads and order of tiles gives the same bits.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "math/simd_target.h"
#include "rainref/executor.h"
#include "rainref/variant.h"

namespace rainref::test {

/// Tests of one variant each. The best SIMD target is selected again after each.
class OfVariant : public testing::TestWithParam<Variant> {
 protected:
  ~OfVariant() override { select_simd_target(""); }
};
inline const auto both_variants = testing::Values(Variant::as_published, Variant::corrected);
inline std::string variant_name(const testing::TestParamInfo<Variant>& variant) {
  return variant.param == Variant::corrected ? "corrected" : "as_published";
}

/// The hash of its next three frames.
template <class Effect>
std::string hash_of_frames(Effect effect) {
  capture::HashRecorder recorder;
  for (int frame = 0; frame < 3; ++frame) {
    effect.next_frame(&recorder);
    recorder.take_lines();
  }
  return recorder.scene_hash().text();
}

/// run(executor) gives with every target, these numbers of threads and tiles in any order what it gives with the last target and one
/// thread. `what` says which run it is.
template <class Run>
void expect_one_result(const std::string& what, const Run& run, std::initializer_list<int> thread_counts = {1, 2, 3, 8}) {
  select_simd_target(simd_targets().back());
  const std::string expected = run(parallel::Executor(1));
  std::uint64_t shuffle = std::hash<std::string>()(what);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    for (const int threads : thread_counts) {
      parallel::Executor executor(threads);
      executor.shuffle_tiles(++shuffle);
      ASSERT_EQ(run(executor), expected) << what << ", " << target << ", " << threads << " threads";
    }
  }
}

}  // namespace rainref::test
