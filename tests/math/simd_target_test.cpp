// SIMD targets can be listed and selected, and a refusal keeps the selection.
#include "math/simd_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "math/half_array.h"

namespace rainref {
namespace {

TEST(SimdTarget, TheBestComesFirstAndScalarIsAlwaysThere) {
  const std::vector<std::string> targets = simd_targets();
  ASSERT_FALSE(targets.empty());
#ifdef HWY_COMPILE_ONLY_STATIC  // as the sanitizers' presets are built: the compiler's own target alone
  EXPECT_EQ(targets.size(), 1u);
#else
  EXPECT_EQ(targets.back() == "scalar" || targets.back() == "neon" || targets.back() == "wasm", true) << targets.back();
#endif
  EXPECT_EQ(std::count(targets.begin(), targets.end(), targets.front()), 1);
  select_simd_target("");
  EXPECT_EQ(selected_simd_target(), targets.front());
}

TEST(SimdTarget, CanBeSelectedAgainAndAgain) {
  const std::vector<std::string> targets = simd_targets();
  const float x[3] = {1, 2, 3};
  for (int round = 0; round < 2; ++round) {
    for (const std::string& target : targets) {
      select_simd_target(target);
      EXPECT_EQ(selected_simd_target(), target);
      EXPECT_EQ(simd_targets(), targets) << "a selection hides no target";
      Half h[3] = {};
      to_half_array(x, h, 3, Rounding::rne);
      EXPECT_EQ(h[2].bits, 0x4200);
    }
  }
  select_simd_target("");
  EXPECT_EQ(selected_simd_target(), targets.front());
}

TEST(SimdTarget, ARefusalNamesTheOnesThatAreHereAndKeepsTheSelection) {
  if (simd_targets().back() != "scalar") GTEST_SKIP() << "built for " << simd_targets().back() << " alone";
  select_simd_target("scalar");
  EXPECT_THAT(
      error_of([] { select_simd_target("scaler"); }),
      testing::AllOf(testing::StartsWith("2 SIMD target 'scaler': this machine has "), testing::HasSubstr("did you mean 'scalar'?")));
  EXPECT_EQ(selected_simd_target(), "scalar");
  select_simd_target("");
}

}  // namespace
}  // namespace rainref
