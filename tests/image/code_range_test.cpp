// Code ranges against their definition: every half, every 8-bit code, and what lies between them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "image/code_range.h"
#include "image/colour.h"
#include "math/half.h"
#include "math/unorm.h"

namespace rainref::enclosed {
namespace {

using Kind = FormatInfo::Kind;

std::int64_t ordered(Half h) {
  std::byte bytes[2];
  std::memcpy(bytes, &h.bits, 2);
  return ordered_code(Kind::float16, bytes);
}
StoreRules halves(StoreRounding rounding, StoreOverflow overflow = StoreOverflow::inf) {
  StoreRules r;
  r.half = rounding;
  r.half_overflow = overflow;
  return r;
}
CodeRange half_range(float lo, float hi, const StoreRules& rules) { return code_range(Kind::float16, {lo, hi}, rules); }
::testing::AssertionResult is(const CodeRange& r, std::int64_t lo, std::int64_t hi) {
  if (r.lo == lo && r.hi == hi) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "[" << r.lo << ", " << r.hi << "], expected [" << lo << ", " << hi << "]";
}

TEST(CodeRange, EveryHalfAndWhatLiesBetweenItAndTheNext) {
  for (int code = -0x7bff; code < 0x7bff; ++code) {
    const auto value = [](int c) { return static_cast<float>(code_value(Kind::float16, c)); };
    const float here = value(code), next = value(code + 1), middle = static_cast<float>((static_cast<double>(here) + next) / 2);
    for (const StoreRounding rounding : {StoreRounding::rne, StoreRounding::rtz, StoreRounding::either}) {
      ASSERT_TRUE(is(half_range(here, here, halves(rounding)), code, code)) << here;
    }
    const int inward = code < 0 ? code + 1 : code, even = code % 2 == 0 ? code : code + 1;
    for (const float x : {next_up(here), next_down(middle), middle, next_up(middle), next_down(next)}) {
      const int nearest = x < middle ? code : x > middle ? code + 1 : even;
      ASSERT_TRUE(is(half_range(x, x, halves(StoreRounding::rne)), nearest, nearest)) << x;
      ASSERT_TRUE(is(half_range(x, x, halves(StoreRounding::rtz)), inward, inward)) << x;
      ASSERT_TRUE(is(half_range(x, x, halves(StoreRounding::either)), code, code + 1)) << x;
      ASSERT_TRUE(is(half_range(here, x, halves(StoreRounding::either)), code, code + 1)) << x;
    }
  }
}
TEST(CodeRange, HalfIntervalsAreTheHullOfTheirPoints) {
  std::mt19937 words(3);
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] {
      return to_float(Half{static_cast<std::uint16_t>(words() % 0x7c00 | (words() & 0x8000))}) * (1 + (words() & 0xff) * 0x1p-18f);
    };
    float a = any(), b = any();
    if (a > b) std::swap(a, b);
    for (const StoreRounding rounding : {StoreRounding::rne, StoreRounding::rtz, StoreRounding::either}) {
      const CodeRange low = half_range(a, a, halves(rounding)), high = half_range(b, b, halves(rounding));
      ASSERT_TRUE(is(half_range(a, b, halves(rounding)), low.lo, high.hi));
    }
    ASSERT_TRUE(half_range(a, b, halves(StoreRounding::rne)).contains(ordered(to_half(a))));
    ASSERT_TRUE(half_range(a, b, halves(StoreRounding::rtz)).contains(ordered(to_half(b, Rounding::rtz))));
  }
}
TEST(CodeRange, HalvesOverflowAsTheRulesSay) {
  using R = StoreRounding;
  using O = StoreOverflow;
  constexpr std::int64_t max = 0x7bff, inf = 0x7c00;
  const struct {
    float x;
    R rounding;
    O overflow;
    std::int64_t lo, hi;
  } cases[] = {{65504, R::either, O::either, max, max}, {65519, R::rne, O::inf, max, max},    {65520, R::rne, O::inf, inf, inf},
               {65520, R::rne, O::max, max, max},       {65520, R::rne, O::either, max, inf}, {65535, R::rtz, O::inf, max, max},
               {65536, R::rtz, O::inf, inf, inf},       {65536, R::rtz, O::max, max, max},    {1e9f, R::rtz, O::either, max, inf},
               {65505, R::either, O::inf, max, inf},    {65505, R::either, O::max, max, max}, {65536, R::either, O::inf, inf, inf},
               {65536, R::either, O::either, max, inf}};
  for (const auto& c : cases) {
    EXPECT_TRUE(is(half_range(c.x, c.x, halves(c.rounding, c.overflow)), c.lo, c.hi)) << c.x;
    EXPECT_TRUE(is(half_range(-c.x, -c.x, halves(c.rounding, c.overflow)), -c.hi, -c.lo)) << -c.x;
  }
}

// Every subnormal half and each place between two of them: flushed, its range goes on to 0; the least normal one stays.
TEST(CodeRange, SubnormalHalvesMayBeFlushed) {
  for (const StoreRounding rounding : {StoreRounding::rne, StoreRounding::rtz, StoreRounding::either}) {
    StoreRules kept = halves(rounding), flushed = kept;
    flushed.half_flush = true;
    for (int code = 1; code <= 0x401; ++code) {
      const float here = to_float(Half{static_cast<std::uint16_t>(code)}), next = to_float(Half{static_cast<std::uint16_t>(code + 1)});
      for (const float x : {here, (here + next) / 2}) {
        const CodeRange range = half_range(x, x, kept);
        ASSERT_GT(range.lo, 0);
        ASSERT_TRUE(is(half_range(x, x, flushed), range.lo < 0x400 ? 0 : range.lo, range.hi)) << x;
        ASSERT_TRUE(is(half_range(-x, -x, flushed), -range.hi, range.lo < 0x400 ? 0 : -range.lo)) << -x;
      }
    }
    EXPECT_TRUE(
        is(half_range(-0x1p-20f, 0x1p-16f, flushed), half_range(-0x1p-20f, 0x1p-16f, kept).lo, half_range(-0x1p-20f, 0x1p-16f, kept).hi));
  }
}

TEST(CodeRange, FloatsAreOrderedAndTheirZerosOne) {
  const auto code = [](float x) {
    std::byte bytes[4];
    std::memcpy(bytes, &x, 4);
    return ordered_code(Kind::float32, bytes);
  };
  EXPECT_EQ(code(0.0f), 0);
  EXPECT_EQ(code(-0.0f), 0);
  for (const float x : {-3e38f, -1.0f, -0x1p-149f, 0x1p-149f, 1.0f, 65504.0f}) {
    EXPECT_EQ(code(next_up(x)), code(x) + 1) << x;
    EXPECT_TRUE(is(code_range(Kind::float32, {x, next_up(x)}, {}), code(x), code(x) + 1));
    EXPECT_EQ(static_cast<float>(code_value(Kind::float32, code(x))), x);
  }
}
TEST(CodeRange, NotANumberIsInNoRange) {
  const std::uint32_t nan = 0x7fc00000, negative = 0xffc00000;
  const std::uint16_t half_nan = 0x7e00;
  std::byte bytes[4];
  const CodeRange all{-0x7f800000LL, 0x7f800000LL};
  std::memcpy(bytes, &nan, 4);
  EXPECT_FALSE(all.contains(ordered_code(Kind::float32, bytes)));
  EXPECT_TRUE(CodeRange::vacuous().contains(ordered_code(Kind::float32, bytes)));
  std::memcpy(bytes, &negative, 4);
  EXPECT_FALSE(all.contains(ordered_code(Kind::float32, bytes)));
  std::memcpy(bytes, &half_nan, 2);
  EXPECT_GT(ordered_code(Kind::float16, bytes), 0x7c00);
  for (const Kind kind : {Kind::float32, Kind::float16, Kind::unorm8, Kind::srgb8, Kind::uint32}) {
    EXPECT_TRUE(code_range(kind, Enclosure::vacuous(), {}).is_vacuous());
  }
}

StoreRules unorms(double ulp, Rounding rounding = Rounding::rne) {
  StoreRules r;
  r.unorm = rounding;
  r.unorm_ulp = r.srgb_ulp = ulp;
  return r;
}
TEST(CodeRange, EveryUnormCodeIsExact) {
  for (int code = 0; code < 256; ++code) {
    const float x = to_float(Unorm8{static_cast<std::uint8_t>(code)});
    for (const double ulp : {0.0, 0.5, 0.6, 1.0})
      ASSERT_TRUE(is(code_range(Kind::unorm8, {x, x}, unorms(ulp)), code, code)) << code << ' ' << ulp;
    ASSERT_TRUE(is(code_range(Kind::unorm8, {0.0f, x}, unorms(0.6)), 0, code));
    ASSERT_TRUE(is(code_range(Kind::unorm8, {-x - 1, x - 1}, unorms(1)), 0, 0));
  }
  EXPECT_TRUE(is(code_range(Kind::unorm8, {2.0f, 3.0f}, unorms(1)), 255, 255));
}
TEST(CodeRange, UnormCodesLieWithinTheStatedDistance) {
  std::mt19937 words(5);
  for (int i = 0; i < 200000; ++i) {
    const float x = static_cast<float>(words() * 0x1p-32);
    const double scaled = 255.0 * x;
    for (const double ulp : {0.0, 0.6, 1.0}) {
      const CodeRange r = code_range(Kind::unorm8, {x, x}, unorms(ulp));
      ASSERT_TRUE(r.contains(to_unorm8(x).code));
      for (int code = static_cast<int>(scaled) - 1; code <= static_cast<int>(scaled) + 2; ++code) {
        const double distance = std::abs(code - scaled);
        // The reference rounds 255 x to a float before it rounds to a code: at a tie both count.
        const bool tie = std::abs(distance - 0.5) < 2e-5;
        if (code >= 0 && code <= 255 && !tie && std::abs(distance - 1) > 2e-5 && distance > 2e-5) {
          ASSERT_EQ(r.contains(code), distance < std::max(0.5, ulp)) << x << ' ' << code;
        }
      }
      const CodeRange cut = code_range(Kind::unorm8, {x, x}, unorms(ulp, Rounding::rtz));
      ASSERT_TRUE(cut.contains(to_unorm8(x, Rounding::rtz).code) && cut.contains(static_cast<int>(scaled)) && cut.hi - cut.lo <= 1);
    }
  }
}
TEST(CodeRange, SrgbCodesHoldTheirOwnColour) {
  for (int code = 0; code < 256; ++code) {
    const auto x = static_cast<float>(decode_srgb(code / 255.0));
    ASSERT_TRUE(is(code_range(Kind::srgb8, {x, x}, unorms(0)), code, code));
    ASSERT_TRUE(is(code_range(Kind::srgb8, {x, x}, unorms(0.6)), code, code));
    const auto middle = static_cast<float>(decode_srgb((code + 0.5) / 255));
    if (code < 255) {
      ASSERT_TRUE(is(code_range(Kind::srgb8, {middle, middle}, unorms(0.6)), code, code + 1));
    }
    EXPECT_NEAR(code_value(Kind::srgb8, code), decode_srgb(code / 255.0), 1e-12);
  }
}
TEST(CodeRange, IntegersAreCut) {
  EXPECT_TRUE(is(code_range(Kind::uint32, {2.5f, 7.9f}, {}), 2, 7));
  EXPECT_TRUE(is(code_range(Kind::uint32, {-2.5f, 1e20f}, {}), 0, 4294967295LL));
}
TEST(CodeRange, TextGivesValueAndBits) {
  EXPECT_EQ(code_text(Kind::float16, 0x3c00), "1 (0x3c00)");
  EXPECT_EQ(code_text(Kind::float16, -1), "-5.96046e-08 (0x8001)");
  EXPECT_EQ(code_text(Kind::float32, 0x3f800000), "1 (0x3f800000)");
  EXPECT_EQ(code_text(Kind::unorm8, 51), "0.2 (0x33)");
  EXPECT_EQ(code_text(Kind::uint32, 4294967295LL), "4294967295 (0xffffffff)");
}

}  // namespace
}  // namespace rainref::enclosed
