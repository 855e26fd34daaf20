// Fresnel's means, the errors of Schlick's formula, Snell and Beer against tables and closed forms (P9, P10). Fresnel at each angle:
// tests/math/optics_test.cpp.
//
// The passes' constants are floats: 1.333 is off by 6e-8, f0 and the ratios of indices by half an ulp. So the double
// evaluation agrees with closed forms in double to 2e-7, the float evaluation to 1e-6; a table adds half of its last digit.
#include <functional>

#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

constexpr double ior = 1.333;
constexpr double double_error = 2e-7, float_error = 1e-6;
const float f0 = ((1.0f - scalar::water_ior) / (1.0f + scalar::water_ior)) * ((1.0f - scalar::water_ior) / (1.0f + scalar::water_ior));

double schlick(double cosine) { return scalar::fresnel_schlick<Double>(Double(cosine), f0).v; }
double exact(double cosine) { return scalar::fresnel_dielectric<Double>(Double(cosine), scalar::water_ior).v; }

// 2 integral of R(mu) mu dmu over [0, 1]: Simpson's rule in 2000 intervals.
double cosine_mean(const std::function<double(double)>& reflectance) {
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double mu = static_cast<double>(i) / n;
    sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * reflectance(mu) * mu;
  }
  return 2 * sum / (3 * n);
}

TEST(PuddleOptics, CosineMeansOfFresnel) {
  EXPECT_NEAR(cosine_mean(exact), .066406, 5e-7 + double_error);
  EXPECT_NEAR(cosine_mean(schlick), .067022, 5e-7 + double_error);
  EXPECT_NEAR(cosine_mean(schlick), f0 + (1 - f0) / 21, double_error) << "closed form";
}

TEST(PuddleOptics, ExtremesOfSchlicksError) {
  struct Extreme {
    double value = 0, angle = 0;
  } low, high, relative_low, relative_high;
  const auto take = [](Extreme& e, bool better, double value, double angle) {
    if (better) e = {value, angle};
  };
  for (double angle = 0; angle <= 90; angle += 0.01) {
    const double c = std::cos(angle * degree), e = exact(c), d = schlick(c) - e;
    take(low, d < low.value, d, angle);
    take(high, d > high.value, d, angle);
    take(relative_low, d / e < relative_low.value, d / e, angle);
    take(relative_high, d / e > relative_high.value, d / e, angle);
  }
  // Half of the last digit of each tabulated number; the extremes are flat, so their angles are known to 0.1 degrees.
  EXPECT_NEAR(low.value, -.00936, 5e-6 + double_error);
  EXPECT_NEAR(low.angle, 56.8, 0.1);
  EXPECT_NEAR(high.value, .05918, 5e-6 + double_error);
  EXPECT_NEAR(high.angle, 83.8, 0.1);
  EXPECT_NEAR(relative_low.value, -.227, 5e-4);
  EXPECT_NEAR(relative_low.angle, 51.2, 0.1);
  EXPECT_NEAR(relative_high.value, .145, 5e-4);
  EXPECT_NEAR(relative_high.angle, 78.8, 0.1);
}

template <class N>
Vec3<N> into_water(double angle) {
  using T = decltype(N().v);
  const Vec3<N> view(N(static_cast<T>(std::sin(angle * degree))), N(static_cast<T>(-std::cos(angle * degree))), N(0.0f));
  return scalar::refract(view, Vec3<N>(N(0.0f), N(1.0f), N(0.0f)), 1.0f / scalar::water_ior);
}

TEST(PuddleOptics, SnellHasTheTabulatedPathsAndOffsets) {
  struct Case {
    double angle, path, lateral;
  };
  for (const Case& c : {Case{0, 1, 0}, {30, 1.0788, .4046}, {60, 1.3154, .8546}, {80, 1.4838, 1.0962}}) {
    const Vec3<Double> d = into_water<Double>(c.angle);
    const Vec3<Single> f = into_water<Single>(c.angle);
    EXPECT_NEAR(-1 / d.y.v, c.path, 5e-5 + double_error) << c.angle;
    EXPECT_NEAR(-d.x.v / d.y.v, c.lateral, 5e-5 + double_error) << c.angle;
    EXPECT_NEAR(-1 / f.y.v, c.path, 5e-5 + float_error) << c.angle;
    EXPECT_NEAR(-f.x.v / f.y.v, c.lateral, 5e-5 + float_error) << c.angle;
  }
}

TEST(PuddleOptics, SnellsInvariantHoldsAtEveryAngle) {
  for (double angle = 0; angle < 90; angle += 0.5) {
    const Vec3<Double> d = into_water<Double>(angle);
    EXPECT_NEAR(ior * d.x.v, std::sin(angle * degree), double_error) << angle;
    EXPECT_NEAR(d.x.v * d.x.v + d.y.v * d.y.v, 1, double_error) << "a unit vector stays one";
    const Vec3<Single> f = into_water<Single>(angle);
    EXPECT_NEAR(ior * f.x.v, std::sin(angle * degree), float_error) << angle;
  }
}

TEST(PuddleOptics, BeyondTheCriticalAngleNothingIsRefracted) {
  // From water into air the critical angle is asin(1 / 1.333).
  const double critical = std::asin(1 / ior) / degree;
  EXPECT_NEAR(critical, 48.607, 5e-4);
  const auto into_air = [](double angle) {
    const Vec3<Double> view(Double(std::sin(angle * degree)), Double(std::cos(angle * degree)), Double(0.0f));
    return scalar::refract(view, Vec3<Double>(Double(0.0f), Double(-1.0f), Double(0.0f)), scalar::water_ior);
  };
  const Vec3<Double> grazing = into_air(critical - 1e-4), none = into_air(critical + 1e-4);
  EXPECT_GT(grazing.x.v, 0.999);
  EXPECT_GT(grazing.y.v, 0);
  EXPECT_EQ(none.x.v, 0);
  EXPECT_EQ(none.y.v, 0);
  EXPECT_EQ(none.z.v, 0);
}

TEST(PuddleOptics, ObliquePathThroughAnUnevenColumnIsTheColumnOverTheCosine) {
  // exp(-a d / cos theta_t): what a slanted ray keeps of the light, and the product law over split depths.
  for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
    const double slant = -1 / into_water<Double>(angle).y.v;
    const auto kept = [slant](double depth) { return scalar::transmittance(Double(0.7), Double(depth * slant)).v; };
    EXPECT_NEAR(kept(2), std::exp(-0.7 * 2 / std::cos(std::asin(std::sin(angle * degree) / ior))), 4 * double_error);
    EXPECT_NEAR(kept(2), kept(0.5) * kept(1.5), 1e-15);
  }
}

}  // namespace
}  // namespace rainref::puddle::test
