// Steps of a function are found where its code changes, or a bucket with two is refused.
#include "image/code_steps.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

namespace rainref {
namespace {

int looked_up(const CodeSteps& steps, float x) {
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const CodeSteps::Bucket& b = steps.data()[std::max((bits >> CodeSteps::shift) - CodeSteps::first, 0)];
  return b.code + (x >= b.step ? 1 : 0);
}
template <class F>
CodeSteps steps_of(const F& f) {
  return CodeSteps([&](const float* x, std::uint8_t* code, int count) {
    for (int k = 0; k < count; ++k) code[k] = static_cast<std::uint8_t>(f(x[k]));
  });
}

// Every step of a function that is known: k / 255 is where code k begins.
TEST(CodeSteps, BeginWhereTheFunctionSteps) {
  const auto code = [](float x) { return static_cast<int>(std::floor(x * 255.0)); };
  const CodeSteps steps = steps_of(code);
  ASSERT_FALSE(steps.empty());
  for (int k = 0; k <= 255; ++k) {
    const float at = static_cast<float>(k / 255.0);
    for (float x : {std::nextafter(at, -1.0f), at, std::nextafter(at, 2.0f)}) {
      x = std::clamp(x, 0.0f, 1.0f);
      ASSERT_EQ(looked_up(steps, x), code(x)) << x;
    }
  }
}
// A step at the first and at the last number of a bucket, in the lowest bucket, and at 1.
TEST(CodeSteps, MayStandAtTheEndsOfBuckets) {
  for (const float at : {0.5f, std::nextafter(0.5f, 0.0f), 0x1p-149f, 0x1p-20f, std::nextafter(0x1.02p-12f, 0.0f), 0x1.02p-12f, 1.0f}) {
    const auto code = [at](float x) { return x >= at ? 1 : 0; };
    const CodeSteps steps = steps_of(code);
    ASSERT_FALSE(steps.empty());
    for (const float x : {0.0f, 0x1p-149f, 0x1p-20f, std::nextafter(at, -1.0f), at, std::nextafter(at, 2.0f), 0.25f, 1.0f})
      if (x >= 0 && x <= 1) {
        ASSERT_EQ(looked_up(steps, x), code(x)) << at << ' ' << x;
      }
  }
}
TEST(CodeSteps, AreNoneWhereABucketWouldNeedTwo) {
  EXPECT_TRUE(steps_of([](float x) { return x < 0.3f ? 0 : 2; }).empty());
  EXPECT_TRUE(steps_of([](float) { return 1; }).empty()) << "not 0 at 0";
  EXPECT_TRUE(CodeSteps().empty());
}

}  // namespace
}  // namespace rainref
