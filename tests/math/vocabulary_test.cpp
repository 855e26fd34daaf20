// Vocabulary of the passes against formulas written independently in double.
#include <gtest/gtest.h>

#include <cmath>

#include "math/scalar.h"

namespace rainref::test {
namespace {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;
using V = scalar::Vec3<D>;
constexpr double pi = 3.14159265358979323846;

V vector(double x, double y, double z) { return V(D(x), D(y), D(z)); }

TEST(Floor, IsTheLargestWholeNumberNotAboveWithAPositiveZero) {
  for (const float x : {0.0f, -0.0f, 0.5f, -0.5f, 1.0f, -1.0f, 1.9999999f, -1.0000001f, 0x1p-149f, -0x1p-149f, 8388607.5f, -8388607.5f,
                        0x1p23f, -0x1p23f, 0x1p30f, 0x1.fffffep127f, -0x1.fffffep127f}) {
    EXPECT_EQ(floor(F(x)).v, std::floor(x)) << x;
    EXPECT_EQ(std::signbit(floor(F(x)).v), std::floor(x) < 0) << x;
    EXPECT_EQ(floor(D(double{x})).v, std::floor(double{x})) << x;
  }
}

TEST(Fract, LiesInTheUnitIntervalAndReachesOneJustBelowZero) {
  EXPECT_EQ(fract(F(1.25f)).v, 0.25f);
  EXPECT_EQ(fract(F(-0.25f)).v, 0.75f);
  EXPECT_EQ(fract(F(0x1p24f)).v, 0.0f);
  EXPECT_EQ(fract(F(-0x1p-30f)).v, 1.0f);  // rounds up, as on a GPU
}

TEST(Mix, IsExactAtBothEnds) {
  for (const float a : {0.1f, -3.0f, 1e20f, 0x1p-140f}) {
    for (const float b : {0.7f, 5.0f, -1e20f}) {
      EXPECT_EQ(mix(F(a), F(b), F(0.0f)).v, a);
      EXPECT_EQ(mix(F(a), F(b), F(1.0f)).v, b);
      EXPECT_NEAR(mix(D(double{a}), D(double{b}), D(0.25)).v, 0.75 * a + 0.25 * b, 1e-12 * (std::fabs(a) + std::fabs(b)));
    }
  }
}

TEST(MinMax, OfEqualNumbersIsTheFirst) {
  EXPECT_TRUE(std::signbit(min(F(-0.0f), F(0.0f)).v));
  EXPECT_FALSE(std::signbit(min(F(0.0f), F(-0.0f)).v));
  EXPECT_TRUE(std::signbit(max(F(-0.0f), F(0.0f)).v));
  EXPECT_FALSE(std::signbit(max(F(0.0f), F(-0.0f)).v));
}

TEST(Smoothstep, IsTheCubicForRisingAndFallingEdges) {
  for (int k = -20; k <= 120; ++k) {
    const double x = k / 20.0, t = std::clamp((x - 0.5) / 3.5, 0.0, 1.0), s = t * t * (3 - 2 * t);
    EXPECT_NEAR(scalar::smoothstep(0.5f, 4.0f, D(x)).v, s, 1e-15);
    EXPECT_NEAR(scalar::smoothstep(4.0f, 0.5f, D(x)).v, 1 - s, 1e-15);
    EXPECT_NEAR(scalar::smoothstep(0.5f, 4.0f, F(static_cast<float>(x))).v, s, 5e-7);
  }
  EXPECT_EQ(scalar::smoothstep(4.0f, 0.5f, F(0.5f)).v, 1.0f);
  EXPECT_EQ(scalar::smoothstep(4.0f, 0.5f, F(4.0f)).v, 0.0f);
}

TEST(Vectors, LengthDotAndNormalize) {
  EXPECT_EQ(scalar::length(vector(2, 3, 6)).v, 7);
  EXPECT_EQ(scalar::length(D(3.0), D(4.0)).v, 5);
  EXPECT_EQ(scalar::dot(vector(1, 2, 3), vector(4, -5, 6)).v, 12);
  const V n = scalar::normalize(vector(1, -2, 2));
  EXPECT_NEAR(n.x.v, 1 / 3.0, 1e-15);
  EXPECT_NEAR(n.y.v, -2 / 3.0, 1e-15);
  const float uniform[3] = {1, 2, 3};
  EXPECT_EQ(V(uniform).z.v, 3);
}

TEST(Vectors, TheSumOfAnyOrderGoesFromLeftToRight) {
  EXPECT_EQ(scalar::sum_any_order(F(0x1p24f), F(1.0f), F(1.0f)).v, 0x1p24f);
  EXPECT_EQ(scalar::sum_any_order(F(1.0f), F(1.0f), F(0x1p24f)).v, 0x1p24f + 2);
  EXPECT_EQ(scalar::sum_any_order(F(0x1p24f), F(1.0f), F(1.0f), F(-0x1p24f)).v, 0.0f);
}

TEST(Reflect, KeepsTheLengthAndTurnsTheNormalPart) {
  const V n = scalar::normalize(vector(0.3, 1, -0.2)), v = scalar::normalize(vector(1, -2, 0.5)), r = scalar::reflect(v, n);
  EXPECT_NEAR(scalar::length(r).v, 1, 1e-15);
  EXPECT_NEAR(scalar::dot(r, n).v, -scalar::dot(v, n).v, 1e-15);
  const V along = v + r, cross = along - scalar::dot(along, n) * n;  // the tangential part is kept
  EXPECT_NEAR(scalar::length(cross).v, scalar::length(along).v, 1e-15);
}

TEST(Refract, ObeysSnellInThePlaneOfIncidence) {
  const V up = vector(0, 1, 0);
  for (int degrees = 0; degrees < 90; ++degrees) {
    const double i = degrees * pi / 180;
    const V down = vector(std::sin(i), -std::cos(i), 0);
    const V in = scalar::refract(down, up, 0.75f);  // air to water, nearly
    EXPECT_NEAR(in.x.v, 0.75 * std::sin(i), 1e-15) << degrees;
    EXPECT_NEAR(scalar::length(in).v, 1, 1e-14) << degrees;
    EXPECT_LT(in.y.v, 0);
    const V out = scalar::refract(down, up, 1.25f);
    if (1.25 * std::sin(i) < 1) {
      EXPECT_NEAR(out.x.v, 1.25 * std::sin(i), 1e-14) << degrees;
      EXPECT_NEAR(scalar::length(out).v, 1, 1e-13) << degrees;
    } else {  // total internal reflection
      EXPECT_EQ(scalar::length(out).v, 0) << degrees;
    }
  }
}

struct Count {
  F x, rounds;
  friend Count select(bool m, const Count& a, const Count& b) { return m ? a : b; }
};

TEST(AdvanceWhile, CountsTheRoundThatSaysStopAndHonoursTheLimit) {
  const auto body = [](int, const Count& s) {
    const F x = s.x * F(2.0f);
    return scalar::Round<bool, Count>{x < F(100.0f), {x, s.rounds + F(1.0f)}};
  };
  const Count end = scalar::advance_while(50, Count{F(1.0f), F(0.0f)}, true, body);
  EXPECT_EQ(end.x.v, 128.0f);
  EXPECT_EQ(end.rounds.v, 7.0f);
  EXPECT_EQ(scalar::advance_while(3, Count{F(1.0f), F(0.0f)}, true, body).x.v, 8.0f);
  EXPECT_EQ(scalar::advance_while(0, Count{F(1.0f), F(0.0f)}, true, body).x.v, 1.0f);
  EXPECT_EQ(scalar::advance_while(50, Count{F(1.0f), F(0.0f)}, false, body).x.v, 1.0f);
}

}  // namespace
}  // namespace rainref::test
