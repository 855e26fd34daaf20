// The plain evaluations of vocabulary and optics against formulas of the textbook, written independently in double.
#include <gtest/gtest.h>

#include <cmath>

#include "math/scalar.h"

namespace rainref::test {
namespace evaluations {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace evaluations

namespace {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;
constexpr double pi = 3.14159265358979323846;

/// Fresnel by angles, which never meet in the source.
double fresnel(double cos_i, double eta) {
  const double i = std::acos(cos_i), t = std::asin(std::sin(i) / eta);
  if (i < 1e-9) return std::pow((eta - 1) / (eta + 1), 2);
  const double perpendicular = std::sin(i - t) / std::sin(i + t), parallel = std::tan(i - t) / std::tan(i + t);
  return 0.5 * (perpendicular * perpendicular + parallel * parallel);
}

TEST(Fresnel, IsFresnelsFormulaByAngles) {
  for (int k = 1; k < 900; ++k) {
    const double cos_i = std::cos(k * 0.1 * pi / 180);
    EXPECT_NEAR(evaluations::fresnel_dielectric(D(cos_i), 1.333f).v, fresnel(cos_i, double{1.333f}), 1e-8) << k * 0.1;
    EXPECT_NEAR(evaluations::fresnel_dielectric(F(static_cast<float>(cos_i)), 1.333f).v, fresnel(cos_i, double{1.333f}), 4e-6) << k * 0.1;
  }
}

TEST(Fresnel, KnownValuesOfWater) {
  const struct {
    double degrees, exact, schlick;
  } table[] = {{30, .021436, .020415}, {45, .027898, .022485}, {60, .059691, .050987}, {70, .133475, .141189},
               {75, .212378, .239493}, {80, .347917, .397846}, {85, .583523, .641305}};
  const float f0 = 0.0203732f;
  for (const auto& row : table) {
    const double cosine = std::cos(row.degrees * pi / 180);
    EXPECT_NEAR(evaluations::fresnel_dielectric(D(cosine), 1.333f).v, row.exact, 6e-7) << row.degrees;
    EXPECT_NEAR(evaluations::fresnel_schlick(D(cosine), f0).v, row.schlick, 6e-7) << row.degrees;
  }
  EXPECT_NEAR(evaluations::fresnel_dielectric(D(1.0), 1.333f).v, 0.0203732, 5e-8);
  EXPECT_NEAR(evaluations::fresnel_dielectric(D(0.0), 1.333f).v, 1, 1e-15);
  EXPECT_NEAR(evaluations::fresnel_dielectric(F(0.0f), 1.333f).v, 1, 1e-6);
}

TEST(Fresnel, VanishesInParallelLightAtBrewstersAngle) {
  const double cosine = std::cos(std::atan(double{1.333f}));
  // Half of the perpendicular part alone is left: ((1 - eta^2) / (1 + eta^2))^2 / 2.
  const double eta2 = double{1.333f} * double{1.333f};
  EXPECT_NEAR(evaluations::fresnel_dielectric(D(cosine), 1.333f).v, 0.5 * std::pow((1 - eta2) / (1 + eta2), 2), 1e-8);
}

TEST(Fresnel, OfSchlickHasTheClosedForm) {
  for (int k = 0; k <= 100; ++k) {
    const double cosine = k / 100.0;
    EXPECT_NEAR(evaluations::fresnel_schlick(D(cosine), 0.02f).v, 0.02 + 0.98 * std::pow(1 - cosine, 5), 3e-8);
    EXPECT_NEAR(evaluations::fresnel_schlick(F(static_cast<float>(cosine)), 0.02f).v, 0.02 + 0.98 * std::pow(1 - cosine, 5), 4e-7);
  }
  EXPECT_EQ(evaluations::fresnel_schlick(F(1.0f), 0.02f).v, 0.02f);
  EXPECT_EQ(evaluations::fresnel_schlick(F(0.0f), 0.02f).v, 1.0f);
}

TEST(Beer, IsExponentialAndMultiplies) {
  for (const double a : {0.0, 0.1, 1.0, 7.0}) {
    for (const double d : {0.0, 0.5, 2.0}) {
      EXPECT_NEAR(evaluations::transmittance(D(a), D(d)).v, std::exp(-a * d), 1e-14);
      EXPECT_NEAR(evaluations::transmittance(F(static_cast<float>(a)), F(static_cast<float>(d))).v, std::exp(-a * d), 1e-6);
      EXPECT_NEAR(evaluations::transmittance(D(a), D(d)).v,
                  evaluations::transmittance(D(a), D(d / 3)).v * evaluations::transmittance(D(a), D(2 * d / 3)).v, 1e-14);
    }
  }
}

template <class N>
auto srgb(N x) {
  return evaluations::encode_srgb(evaluations::Vec3<N>(N(0.5f), x, N(1.0f))).y.v;
}

TEST(Srgb, IsTheCurveOfTheStandard) {
  for (int k = 0; k <= 4000; ++k) {
    const double x = k / 4000.0, code = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    EXPECT_NEAR(srgb(D(x)), code, 2e-7) << x;
    EXPECT_NEAR(srgb(F(static_cast<float>(x))), code, 4e-7) << x;
  }
  EXPECT_EQ(srgb(F(0.0f)), 0.0f);
  EXPECT_NEAR(srgb(F(1.0f)), 1.0f, 0x1p-23);
  EXPECT_NEAR(srgb(F(0.5f)), 0.735357, 1e-6);
  EXPECT_NEAR(srgb(F(0.18f)), 0.461356, 1e-6);
}

}  // namespace
}  // namespace rainref::test
