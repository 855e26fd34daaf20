// The transcendental functions are correctly rounded but for known exceptions, against MPFR, on every target.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <vector>

#include "base/shell.h"
#include "base/temporary_folder.h"
#include "math/every_target.h"
#include "math/transcendental_cases.h"
#include "source_folder.h"

namespace rainref::test {
namespace {

constexpr float largest = 0x1.fffffep127f, smallest = 0x1p-149f;

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

/// The float n steps further from zero, or nearer for n < 0.
float step(float x, int n) { return std::bit_cast<float>(bits_of(x) + static_cast<std::uint32_t>(n)); }

/// Thresholds, breakpoints and hard arguments, each with its neighbours, in both signs.
std::vector<float> special_values() {
  std::vector<float> centres = {0x1p-126f, 0x1p-100f, 0x1p-25f, 0x1p-24f, 0x1p-12f, 0.25f,   0.5f,     1.0f,
                                2.0f,      3.0f,      10.0f,    0x1p22f,  0x1p24f,  0x1p63f, 0x1p100f, 0x1p127f};
  const auto also = [&](std::initializer_list<float> more) { centres.insert(centres.end(), more); };
  also({0x1.62e42ep-2f, 0x1.62e43p-1f, 0x1.0a2b24p1f});                      // exp: ln 2 times 1/2, 1, 3
  also({0x1.62e42ep6f, 0x1.5d58ap6f, 0x1.9d1d9p6f, 0x1.9fe368p6f, 120.0f});  // exp: largest, normal, least, 0, limit
  also({126.0f, 127.0f, 128.0f, 149.0f, 150.0f, 200.0f});                    // exp2, likewise
  also({0x1.6a09e6p-1f, 0x1.6a09e6p0f});                                     // log: sqrt(1/2), sqrt(2)
  also({0x1.a8279ap-2f, 0x1.3504f4p1f});                                     // atan2: tan(pi/8), tan(3 pi/8)
  also({0x1.33333p13f, 0x1.921fb6p100f, 0x1.f37c8ap95f});                    // sin, cos: hard, large, nearly 0
  for (int k = 1; k <= 64; ++k) {
    centres.push_back(static_cast<float>(k * 0x1.921fb54442d18p-1));  // pi/4: where sin and cos split or vanish
    centres.push_back(static_cast<float>(k * 1000003 * 0x1.921fb54442d18p-1));
    centres.push_back(static_cast<float>(k));
    centres.push_back(static_cast<float>(k) + 0.5f);
    centres.push_back(static_cast<float>(k * 0x1.62e42fefa39efp-1));
  }
  std::vector<float> values = {0.0f, -0.0f, largest, -largest};
  for (int n = 0; n < 8; ++n) {
    values.insert(values.end(), {step(smallest, n), -step(smallest, n), step(largest, -n), -step(largest, -n)});
  }
  for (const float centre : centres)
    for (int n = -2; n <= 2; ++n) values.insert(values.end(), {step(centre, n), -step(centre, n)});
  return values;
}

struct Inputs {
  std::vector<float> a, b;
  void add(float x, float y) { a.push_back(x), b.push_back(y); }
};

/// Special values, in pairs where the function has two arguments, and every stride-th float.
Inputs inputs_for(const Case& c, std::uint64_t stride) {
  Inputs in;
  const std::vector<float> specials = special_values();
  for (std::size_t i = 0; i < specials.size(); ++i) {
    if (!has_two_arguments(c.function))
      in.add(specials[i], 0);
    else
      for (std::size_t j = i % 97; j < specials.size(); j += 97) in.add(specials[i], specials[j]);
  }
  for (std::uint64_t i = 0; i < std::uint64_t{1} << 32; i += stride) {
    const auto bits = static_cast<std::uint32_t>(i);
    in.add(finite_from_bits(bits), second_argument(c, bits));
  }
  while (in.a.size() % padded_count != 0) in.add(1, 1);
  return in;
}

std::vector<float> run(const Case& c, const Inputs& in) {
  std::vector<float> out(in.a.size());
  run_lanes(c.function, in.a, in.b, out.data());
  return out;
}

// --- The oracle ------------------------------------------------------------------------------------------------------

TEST(MpfrOracle, KnowsPublishedValues) {
  MpfrOracle oracle;
  EXPECT_EQ(oracle.nearest(Function::exp, 1), 2.71828182845904523536f);
  EXPECT_EQ(oracle.nearest(Function::exp2, 0.5f), 1.41421356237309504880f);
  EXPECT_EQ(oracle.nearest(Function::log, 2), 0.693147180559945309417f);
  EXPECT_EQ(oracle.nearest(Function::log, 10), 2.30258509299404568402f);
  EXPECT_EQ(oracle.nearest(Function::sin, 1), 0.841470984807896506653f);
  EXPECT_EQ(oracle.nearest(Function::cos, 1), 0.540302305868139717401f);
  // K. C. Ng, Argument Reduction for Huge Arguments: Good to the Last Bit (1992): sin(2^120).
  EXPECT_EQ(oracle.nearest(Function::sin, 0x1p120f), 0.377820109360752027f);
  EXPECT_EQ(oracle.nearest(Function::pow, 2, 0.5f), 1.41421356237309504880f);
  EXPECT_EQ(oracle.nearest(Function::pow, 10, -2), 0.01f);
  EXPECT_EQ(oracle.nearest(Function::atan2, 1, -1), 2.35619449019234492885f);
}

TEST(MpfrOracle, RoundsOnceAndSaturates) {
  MpfrOracle oracle;
  EXPECT_EQ(oracle.nearest(Function::exp2, -149.5f), smallest);  // 0.71 of the smallest float
  EXPECT_EQ(oracle.nearest(Function::exp2, -151), 0.0f);
  EXPECT_EQ(oracle.nearest(Function::exp2, 128), largest);
  EXPECT_EQ(oracle.nearest(Function::exp, largest), largest);
  EXPECT_EQ(oracle.nearest(Function::log, 0), -largest);
  EXPECT_EQ(oracle.nearest(Function::log, -1), -largest);
  // 4097^2 = 2^24 + 2^13 + 1 lies halfway between two floats, the even one below.
  EXPECT_EQ(oracle.nearest(Function::pow, 4097, 2), 0x1.002p24f);
  EXPECT_DOUBLE_EQ(oracle.error_in_ulp(Function::pow, 4097, 2, 0x1.002p24f), 0.5);
  EXPECT_DOUBLE_EQ(oracle.error_in_ulp(Function::pow, 4097, 2, step(0x1.002p24f, 2)), 1.5);
}

TEST(MpfrOracle, QuickPathAgrees) {
  MpfrOracle oracle;
  for (const Case& c : cases) {
    const Inputs in = inputs_for(c, 1000003);
    for (std::size_t i = 0; i < in.a.size(); i += 7) {
      const float slow = oracle.nearest(c.function, in.a[i], in.b[i]);
      ASSERT_EQ(bits_of(oracle.nearest_quickly(c.function, in.a[i], in.b[i])), bits_of(slow))
          << c.name << "(" << in.a[i] << ", " << in.b[i] << ")";
    }
  }
}

// --- Accuracy and equal bits -----------------------------------------------------------------------------------------

class Transcendental : public testing::TestWithParam<Case> {};

TEST_P(Transcendental, IsNearestButForKnownExceptions) {
  const Case& c = GetParam();
  const Inputs in = inputs_for(c, 1021);
  const std::vector<float> out = run(c, in);
  MpfrOracle oracle;
  std::uint64_t not_nearest = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float reference = oracle.nearest_quickly(c.function, in.a[i], in.b[i]);
    if (bits_of(out[i]) == bits_of(reference)) continue;
    ++not_nearest;
    ASSERT_NE(out[i], reference) << "a zero of the wrong sign: " << in.a[i] << ", " << in.b[i];
    ASSERT_LE(oracle.error_in_ulp(c.function, in.a[i], in.b[i], out[i]), 1) << in.a[i] << ", " << in.b[i];
  }
  EXPECT_LE(not_nearest, c.not_nearest) << "of " << out.size();
}

TEST_P(Transcendental, HasTheSameBitsOnEveryTarget) {
  const Case& c = GetParam();
  const Inputs in = inputs_for(c, 16381);
  std::vector<float> plain(in.a.size());
  for (std::size_t i = 0; i < plain.size(); ++i) plain[i] = implementation(c.function).plain(in.a[i], in.b[i]);
  for_every_target([&] {
    const std::vector<float> lanes = run(c, in);
    for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_EQ(bits_of(lanes[i]), bits_of(plain[i])) << in.a[i] << ", " << in.b[i];
  });
}

TEST_P(Transcendental, IsFiniteForEveryArgument) {
  const Case& c = GetParam();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float a : {0.0f, -0.0f, -1.0f, 1.0f, 0.5f, smallest, -smallest, largest, -largest, infinity, -infinity})
    for (const float b : {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, smallest, -smallest, largest, -largest})
      EXPECT_TRUE(std::isfinite(implementation(c.function).plain(a, b))) << a << ", " << b;
}

// The oracle of the passes computes in double throughout: the formulas have to hold for arguments that are no floats.
TEST_P(Transcendental, IsGoodInDouble) {
  const Case& c = GetParam();
  for (int i = 0; i < 200000; ++i) {
    const double fraction = std::fmod(i * 0x1.9e3779b97f4a7p-1, 1.0);
    // Small enough that nothing saturates; the angles reach far beyond the split at 2^22.
    const bool angle = c.function == Function::sin || c.function == Function::cos;
    const double a = std::ldexp(1 + fraction, angle ? i % 60 - 20 : i % 26 - 20), b = c.function == Function::pow ? 2.2 : a - 3;
    const double got = implementation(c.function).real(a, b);
    const double expected = MpfrOracle::in_double(c.function, a, b);
    const double scale = angle ? 1 : c.function == Function::pow ? 16 * expected : std::fabs(expected);
    ASSERT_NEAR(got, expected, 0x1p-50 * scale) << a;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Transcendental, testing::ValuesIn(cases), [](const auto& c) {
  std::string name = c.param.name;
  for (char& letter : name)
    if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
  return name;
});

// --- Exact values, shape and identities ------------------------------------------------------------------------------

TEST(TranscendentalExact, PowersOfTwo) {
  for (int k = -149; k <= 127; ++k) EXPECT_EQ(exp2_float(static_cast<float>(k)), std::ldexp(1.0f, k)) << k;
  EXPECT_EQ(exp2_float(128), largest);
  EXPECT_EQ(exp2_float(-150), 0.0f);  // a tie, to even
  EXPECT_EQ(exp_float(0), 1.0f);
  EXPECT_EQ(exp_float(largest), largest);
  EXPECT_EQ(exp_float(-largest), 0.0f);
  EXPECT_EQ(log_float(1), 0.0f);
  EXPECT_FALSE(std::signbit(log_float(1)));
}

TEST(TranscendentalExact, Powers) {
  for (std::uint64_t i = 0; i < 0x7f800000; i += 4999) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(i));
    ASSERT_EQ(pow_float(x, 1), x);
    ASSERT_EQ(pow_float(x, 0), 1.0f);
    ASSERT_EQ(pow_float(1, x), 1.0f);
    ASSERT_EQ(pow_float(1, -x), 1.0f);
  }
  for (const float y : {0.5f, 1.0f, 2.2f, smallest, largest}) {
    for (const float zero : {0.0f, -0.0f, -1.0f, -largest}) {
      EXPECT_EQ(bits_of(pow_float(zero, y)), 0u);
      EXPECT_EQ(pow_float(zero, -y), largest);
      EXPECT_EQ(pow_float(zero, 0), 1.0f);
    }
  }
  EXPECT_EQ(pow_float(largest, largest), largest);
  EXPECT_EQ(pow_float(largest, -largest), 0.0f);
  EXPECT_EQ(pow_float(step(1, -1), largest), 0.0f);
  for (const float zero : {0.0f, -0.0f, -1.0f}) EXPECT_EQ(log_float(zero), -largest);
}

// Where x^y is exactly halfway between two floats, as for many squares, an error in the last place of the double
// decides: the result may be either neighbour.
TEST(TranscendentalExact, TiesOfPowGoEitherWay) {
  MpfrOracle oracle;
  int ties = 0, up = 0;
  for (int n = 4097; n < 5792; n += 2) {
    const float x = static_cast<float>(n), square = pow_float(x, 2), below = static_cast<float>(n * n - 1);
    ASSERT_TRUE(square == below || square == below + 2) << n;
    ASSERT_DOUBLE_EQ(oracle.error_in_ulp(Function::pow, x, 2, square), 0.5);
    ++ties;
    up += square != below;
  }
  EXPECT_EQ(ties, 848);
  EXPECT_GT(up, 0);
}

TEST(TranscendentalExact, SignsOfZero) {
  EXPECT_EQ(bits_of(sin_float(0.0f)), bits_of(0.0f));
  EXPECT_EQ(bits_of(sin_float(-0.0f)), bits_of(-0.0f));
  EXPECT_EQ(cos_float(-0.0f), 1.0f);
  const float pi = 0x1.921fb6p1f, half_pi = 0x1.921fb6p0f;
  for (const float sign : {1.0f, -1.0f}) {
    const float zero = 0 * sign;
    for (const float x : {0.0f, smallest, 1.0f, largest}) {
      EXPECT_EQ(bits_of(atan2_float(zero, x)), bits_of(zero));
      EXPECT_EQ(atan2_float(zero, -x), sign * pi);
    }
    for (const float y : {smallest, 1.0f, largest}) {
      EXPECT_EQ(atan2_float(sign * y, 0.0f), sign * half_pi);
      EXPECT_EQ(atan2_float(sign * y, -0.0f), sign * half_pi);
      EXPECT_EQ(atan2_float(sign * y, y), sign * half_pi / 2);
      EXPECT_EQ(atan2_float(sign * y, -y), sign * 0x1.2d97c8p1f);
    }
  }
}

TEST(TranscendentalShape, IsMonotonicAcrossTheSplits) {
  struct Range {
    const char* name;
    float centre;
    float (*f)(float);
  };
  const Range ranges[] = {
      {"exp at ln(2)/2", 0x1.62e42ep-2f, exp_float},
      {"exp at 1", 1.0f, exp_float},
      {"exp at 80", 80.0f, exp_float},
      {"exp2 at 1/2", 0.5f, exp2_float},
      {"log at sqrt(2)", 0x1.6a09e6p0f, log_float},
      {"log at 1", 1.0f, log_float},
      {"sin at pi/4", 0x1.921fb6p-1f, sin_float},
      {"-cos at pi/4", 0x1.921fb6p-1f, [](float x) { return -cos_float(x); }},
      {"atan at tan(pi/8)", 0x1.a8279ap-2f, [](float x) { return atan2_float(x, 1); }},
      {"atan at 1", 1.0f, [](float x) { return atan2_float(x, 1); }},
      {"pow 2.4 at 1/2", 0.5f, [](float x) { return pow_float(x, 2.4f); }},
  };
  for (const Range& range : ranges) {
    float before = range.f(step(range.centre, -100001));
    for (int n = -100000; n <= 100000; ++n) {
      const float now = range.f(step(range.centre, n));
      ASSERT_LE(before, now) << range.name << ", step " << n;
      before = now;
    }
  }
}

TEST(TranscendentalShape, Symmetries) {
  for (std::uint64_t i = 0; i < 0x7f800000; i += 20011) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(i));
    ASSERT_EQ(bits_of(sin_float(-x)), bits_of(-sin_float(x)));
    ASSERT_EQ(bits_of(cos_float(-x)), bits_of(cos_float(x)));
    const float y = finite_from_bits(bits_of(x) * 2654435761u);
    ASSERT_EQ(bits_of(atan2_float(-x, y)), bits_of(-atan2_float(x, y)));
  }
}

TEST(TranscendentalShape, Identities) {
  for (std::uint64_t i = 0; i < std::uint64_t{1} << 32; i += 4999) {
    const float x = finite_from_bits(static_cast<std::uint32_t>(i));
    const double s = sin_float(x), c = cos_float(x);
    ASSERT_NEAR(s * s + c * c, 1, 0x1p-23) << x;
    ASSERT_NEAR(atan2_float(sin_float(x), cos_float(x)), std::atan2(std::sin(double{x}), std::cos(double{x})), 0x1p-22) << x;
    if (x > 0) {
      // The rounding of the logarithm, at most 103 in size, is an absolute error of the exponent.
      ASSERT_NEAR(exp_float(log_float(x)), x, x * 0x1p-17 + smallest) << x;
      ASSERT_NEAR(pow_float(pow_float(x, 1 / 2.2f), 2.2f), x, x * 0x1p-15 + smallest) << x;
    }
  }
}

// --- The generated tables --------------------------------------------------------------------------------------------

TEST(Coefficients, AreWhatTheScriptWrites) {
  if (std::system("/usr/bin/python3 -c 'import mpmath' > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs python3-mpmath";
  const std::string root = rainref::test::source_folder();
  const auto [written, status] = output_of("/usr/bin/python3 '" + root + "/scripts/make_coefficients.py'");
  ASSERT_EQ(status, 0);
  EXPECT_EQ(written, contents(root + "/src/math/coefficients.h"));
}

}  // namespace
}  // namespace rainref::test
