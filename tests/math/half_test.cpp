// binary16 is its definition at every code and boundary, and on every SIMD target.
#include "math/half.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "math/every_target.h"
#include "math/half_array.h"
#include "math/half_hardware.h"

namespace rainref::test {
namespace {

constexpr Rounding both[] = {Rounding::rne, Rounding::rtz};

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }
float float_of(std::uint32_t bits) { return std::bit_cast<float>(bits); }

/// The value of a finite code, by the definition of binary16.
double value_of(std::uint16_t code) {
  const int exponent = code >> 10 & 31, mantissa = code & 1023;
  const double magnitude = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return code & 0x8000 ? -magnitude : magnitude;
}

/// The code of a finite x by the definition, in double: the multiple of the spacing at x that is nearest, ties to even,
/// or next toward zero.
std::uint16_t code_by_definition(double x, Rounding rounding) {
  const std::uint16_t sign = std::signbit(x) ? 0x8000 : 0;
  const double magnitude = std::fabs(x);
  if (magnitude == 0) return sign;
  const int exponent = std::max(std::ilogb(magnitude), -14);
  const double multiple = std::ldexp(magnitude, 10 - exponent);  // exact
  const double whole = rounding == Rounding::rne ? std::nearbyint(multiple) : std::trunc(multiple);
  const double code = whole + 1024.0 * (exponent + 14);
  const double limit = rounding == Rounding::rne ? 0x7c00 : 0x7bff;
  return static_cast<std::uint16_t>(sign | static_cast<std::uint16_t>(std::min(code, limit)));
}

/// Every boundary of the conversion and its neighbours, in both signs: all halves, all midpoints, the ends.
std::vector<float> boundary_floats() {
  std::vector<float> x;
  const auto add = [&](double centre) {
    const auto at = bits_of(static_cast<float>(centre));
    for (int step = -2; step <= 2; ++step) {
      const std::uint32_t bits = at + static_cast<std::uint32_t>(step);
      if ((bits & 0x7f800000u) == 0x7f800000u) continue;
      x.push_back(float_of(bits));
      x.push_back(-float_of(bits));
    }
  };
  for (std::uint16_t code = 0; code < 0x7c00; ++code) {
    add(value_of(code));
    add(0.5 * (value_of(code) + (code == 0x7bff ? 65536.0 : value_of(static_cast<std::uint16_t>(code + 1)))));
  }
  for (const double end : {65504.0, 65519.0, 65520.0, 65535.0, 65536.0, 1e6, 0x1p100, 0x1.fffffep127, 0x1p-126, 0x1p-149}) add(end);
  return x;
}

TEST(Half, EveryCodeIsItsDefinedValueAndComesBack) {
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const Half h{static_cast<std::uint16_t>(bits)};
    const float x = to_float(h);
    const unsigned magnitude = bits & 0x7fff;
    ASSERT_EQ(std::signbit(x), (bits & 0x8000) != 0) << bits;
    if (magnitude > 0x7c00) {
      ASSERT_TRUE(std::isnan(x)) << bits;
      ASSERT_NE(bits_of(x) & 0x400000u, 0u) << "not quiet: " << bits;
      for (const Rounding r : both) ASSERT_EQ(to_half(x, r).bits, (bits & 0x8000) | 0x7e00) << bits;
      continue;
    }
    if (magnitude == 0x7c00)
      ASSERT_TRUE(std::isinf(x)) << bits;
    else
      ASSERT_EQ(double{x}, value_of(h.bits)) << bits;
    for (const Rounding r : both) ASSERT_EQ(to_half(x, r).bits, bits) << bits;
  }
}

TEST(Half, KnownValues) {
  EXPECT_EQ(to_half(1.0f).bits, 0x3c00);
  EXPECT_EQ(to_half(-2.0f).bits, 0xc000);
  EXPECT_EQ(to_half(65504.0f).bits, 0x7bff);
  EXPECT_EQ(to_half(0x1p-14f).bits, 0x0400);
  EXPECT_EQ(to_half(0x1p-24f).bits, 0x0001);
  EXPECT_EQ(to_half(0x1p-25f).bits, 0x0000);  // a tie, to even
  EXPECT_EQ(to_half(0x1.000002p-25f).bits, 0x0001);
  EXPECT_EQ(to_half(0x1.8p-24f).bits, 0x0002);  // a tie, to even
  EXPECT_EQ(to_half(1.0f / 3).bits, 0x3555);
  EXPECT_EQ(to_half(0.1f).bits, 0x2e66);
  EXPECT_EQ(to_half(0.1f, Rounding::rtz).bits, 0x2e66);
  EXPECT_EQ(to_half(0x1.ff8p-15f).bits, 0x03ff);  // the largest subnormal
  EXPECT_EQ(to_half(0x1.ffbffep-15f).bits, 0x03ff);
  EXPECT_EQ(to_half(0x1.ffcp-15f).bits, 0x0400);  // a tie, to even
  EXPECT_EQ(to_half(-0.0f).bits, 0x8000);
}

TEST(Half, OverflowsFrom65520ToNearestAndNeverTowardZero) {
  const float below = 65520.0f - 0x1p-8f;
  EXPECT_EQ(to_half(below).bits, 0x7bff);
  EXPECT_EQ(to_half(65520.0f).bits, 0x7c00);
  EXPECT_EQ(to_half(-65520.0f).bits, 0xfc00);
  for (std::uint32_t bits = bits_of(65504.0f); bits < 0x7f800000u; bits += 1009) {
    ASSERT_EQ(to_half(float_of(bits), Rounding::rtz).bits, 0x7bff);
    ASSERT_EQ(to_half(-float_of(bits), Rounding::rtz).bits, 0xfbff);
  }
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Rounding r : both) {
    EXPECT_EQ(to_half(infinity, r).bits, 0x7c00);
    EXPECT_EQ(to_half(-infinity, r).bits, 0xfc00);
    EXPECT_EQ(to_half(std::numeric_limits<float>::quiet_NaN(), r).bits, 0x7e00);
    EXPECT_EQ(to_half(float_of(0xff800001u), r).bits, 0xfe00);
  }
}

TEST(Half, IsTheDefinitionAtEveryBoundary) {
  for (const float x : boundary_floats()) {
    for (const Rounding r : both) ASSERT_EQ(to_half(x, r).bits, code_by_definition(x, r)) << x << ' ' << name(r);
  }
}

TEST(Half, IsTheDefinitionOnADenseStride) {
  for (std::uint64_t i = 0; i < std::uint64_t{1} << 32; i += 2003) {
    const auto bits = static_cast<std::uint32_t>(i);
    if ((bits & 0x7f800000u) == 0x7f800000u) continue;
    const float x = float_of(bits);
    for (const Rounding r : both) ASSERT_EQ(to_half(x, r).bits, code_by_definition(x, r)) << x << ' ' << name(r);
  }
}

// half_full does this for all 2^32 floats.
TEST(Half, IsWhatTheProcessorDoes) {
  if (!has_half_hardware()) GTEST_SKIP() << "no F16C";
  std::vector<std::uint16_t> codes(65536);
  std::vector<float> x(65536);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<std::uint16_t>(i);
  to_float_by_hardware(codes.data(), x.data(), x.size());
  for (std::size_t i = 0; i < codes.size(); ++i) ASSERT_EQ(bits_of(to_float(Half{codes[i]})), bits_of(x[i])) << i;

  for (std::uint64_t first = 0; first < std::uint64_t{1} << 32; first += std::uint64_t{65536} * 257) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = float_of(static_cast<std::uint32_t>(first + i * 257));
    for (const Rounding r : both) {
      to_half_by_hardware(x.data(), codes.data(), x.size(), r);
      for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_TRUE(same_half(to_half(x[i], r).bits, codes[i])) << x[i] << ' ' << name(r);
      }
    }
  }
}

TEST(HalfArray, EveryTargetIsTheRuleAtEveryBoundary) {
  std::vector<float> x = boundary_floats();
  for (std::uint64_t i = 0; i < std::uint64_t{1} << 32; i += 20011) {
    const float f = float_of(static_cast<std::uint32_t>(i));
    if (std::isfinite(f)) x.push_back(f);
  }
  std::vector<Half> codes(x.size());
  for_every_target([&] {
    for (const Rounding r : both) {
      to_half_array(x.data(), codes.data(), x.size(), r);
      // A kernel stores x + 0: no -0 leaves it, unless a nonzero number rounds to it.
      for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(codes[i].bits, to_half(x[i] + 0.0f, r).bits) << x[i] << ' ' << name(r);
    }
  });
}

TEST(HalfArray, EveryTargetWidensEveryCodeThatAKernelCanStore) {
  std::vector<Half> codes;
  for (unsigned bits = 0; bits < 65536; ++bits) {
    if ((bits & 0x7fff) <= 0x7c00) codes.push_back({static_cast<std::uint16_t>(bits)});
  }
  std::vector<float> x(codes.size());
  for_every_target([&] {
    to_float_array(codes.data(), x.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(bits_of(x[i]), bits_of(to_float(codes[i]))) << codes[i].bits;
  });
}

TEST(HalfArray, WritesExactlyTheCountGiven) {
  constexpr std::uint16_t untouched = 0xabcd;
  for_every_target([&] {
    for (std::size_t count = 0; count <= 33; ++count) {
      std::vector<float> x;
      for (std::size_t i = 0; i < count; ++i) x.push_back(static_cast<float>(i) * 0.37f - 4);
      std::vector<Half> codes(count + 3, Half{untouched});
      to_half_array(x.data(), codes.data(), count, Rounding::rne);
      for (std::size_t i = 0; i < codes.size(); ++i) {
        ASSERT_EQ(codes[i].bits, i < count ? to_half(x[i]).bits : untouched) << i << " of " << count;
      }
      std::vector<float> back(count + 3, -1.0f);
      to_float_array(codes.data(), back.data(), count);
      for (std::size_t i = 0; i < back.size(); ++i) {
        ASSERT_EQ(back[i], i < count ? to_float(codes[i]) : -1.0f) << i << " of " << count;
      }
    }
  });
}

}  // namespace
}  // namespace rainref::test
