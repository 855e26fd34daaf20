// UNORM8 codes are quotients correctly rounded, and come back.
#include "math/unorm.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace rainref {
namespace {

TEST(Unorm8, EveryCodeIsItsQuotientCorrectlyRoundedAndComesBack) {
  for (int code = 0; code < 256; ++code) {
    const Unorm8 u{static_cast<std::uint8_t>(code)};
    const float x = to_float(u);
    EXPECT_EQ(x, static_cast<float>(static_cast<long double>(code) / 255)) << code;
    EXPECT_EQ(to_unorm8(x).code, code);
  }
}

// code / 255, rounded to float, may lie under the quotient; times 255, rounded again, it is the code all the same.
TEST(Unorm8, TowardZeroKeepsEveryCodeToo) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(to_unorm8(to_float(Unorm8{static_cast<std::uint8_t>(code)}), Rounding::rtz).code, code);
  }
}

TEST(Unorm8, Clamps) {
  for (const Rounding r : {Rounding::rne, Rounding::rtz}) {
    for (const float x : {-0.0f, -0x1p-149f, -0.5f, -1.0f, -0x1.fffffep127f}) EXPECT_EQ(to_unorm8(x, r).code, 0) << x;
    for (const float x : {1.0f, 1.0000001f, 2.0f, 0x1.fffffep127f}) EXPECT_EQ(to_unorm8(x, r).code, 255) << x;
    EXPECT_EQ(to_unorm8(0x1p-149f, r).code, 0);
    EXPECT_EQ(to_unorm8(std::numeric_limits<float>::quiet_NaN(), r).code, 0);  // as Direct3D and Vulkan convert it
  }
}

// The only ties that a float can hit exactly are those of products that are exact: (k + 1/2) / 255 as a dyadic number.
TEST(Unorm8, TiesGoToTheEvenCode) {
  int ties = 0;
  for (int k = 0; k < 255; ++k) {
    const float centre = static_cast<float>((k + 0.5) / 255);
    for (int step = -3; step <= 3; ++step) {
      const float x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(centre) + static_cast<std::uint32_t>(step));
      const float product = x * 255.0f;
      const double nearest = std::nearbyint(double{product});
      ASSERT_EQ(to_unorm8(x).code, nearest) << k << ' ' << step;
      if (product == static_cast<float>(k) + 0.5f) {
        ++ties;
        ASSERT_EQ(to_unorm8(x).code % 2, 0) << k;
      }
    }
  }
  EXPECT_GT(ties, 200);
  EXPECT_EQ(to_unorm8(0.5f).code, 128);  // 127.5
}

TEST(Unorm8, IsTheRoundedProductOnADenseStride) {
  for (std::uint32_t bits = 0; bits <= std::bit_cast<std::uint32_t>(1.0f); bits += 397) {
    const float x = std::bit_cast<float>(bits), product = x * 255.0f;
    ASSERT_EQ(to_unorm8(x).code, std::nearbyint(double{product})) << x;
    ASSERT_EQ(to_unorm8(x, Rounding::rtz).code, std::trunc(double{product})) << x;
    ASSERT_NEAR(to_unorm8(x).code, 255.0 * x, 0.5 + 0x1p-16) << x;
  }
}

TEST(Unorm8, IsMonotonic) {
  int before = 0;
  for (std::uint32_t bits = std::bit_cast<std::uint32_t>(0x1p-10f); bits <= 0x3f800000u; bits += 97) {
    const int code = to_unorm8(std::bit_cast<float>(bits)).code;
    ASSERT_GE(code, before);
    ASSERT_LE(code, before + 1);
    before = code;
  }
  EXPECT_EQ(before, 255);
}

}  // namespace
}  // namespace rainref
