// The sums of the tap patterns on ramps and steps, against closed forms.
#include "edge_splash/support.h"

namespace rainref::edge_splash {
namespace {

// Values as small as a ramp's need no float storage error: multiples of 2^-12 below 8 are exact.
constexpr double grain = 0x1p-12;

// With s = T d^2 whole, gx = 8 a s - 2 b s and gy = 4 b s + 2 b T; true Sobel sums are 8 a s and 8 b s.
TEST(EdgeSplashGradient, PublishedSumsOfARamp) {
  struct Case {
    int thickness;
    double depth;
    int s;
  };
  for (const Case c : {Case{3, 1, 3}, Case{12, 0.5, 3}, Case{16, 0.25, 1}, Case{5, 1, 5}}) {
    for (int a = -8; a <= 8; a += 4) {
      for (int b = -8; b <= 8; b += 2) {
        const double da = a * grain, db = b * grain;
        const Field ramp(64, 64, Address::border, [&](int x, int y) { return c.depth + da * (x - 32) + db * (y - 32); });
        const auto g = published_gradient<D>(c.thickness, ramp, 32, 32);
        EXPECT_EQ(g.x.v, 8 * da * c.s - 2 * db * c.s) << c.thickness << " " << a << " " << b;
        EXPECT_EQ(g.y.v, 4 * db * c.s + 2 * db * c.thickness);
        // The half-plane asks for the sign alone, and that is right: coverage is 1/2 on ramps.
        EXPECT_EQ(g.y.v > 0, b > 0);
        EXPECT_EQ(g.y.v < 0, b < 0);
      }
    }
  }
}

TEST(EdgeSplashGradient, CorrectedSumsOfARamp) {
  for (const int s : {1, 3, 5}) {
    for (int a = -2; a <= 2; ++a) {
      for (int b = -2; b <= 2; ++b) {
        const double da = a * 0.01, db = b * 0.01;
        const Field inverse(64, 64, Address::clamp, [&](int x, int y) { return 1 / (4 + da * (x - 32) + db * (y - 32)); });
        const auto g = corrected_gradient<D>(s, inverse, 32, 32);
        // Each of eight distances near 4 m carries half an ulp of its stored inverse: 4 * 2^-24 m, weights up to 2.
        const double tolerance = 12 * 4.5 * 0x1p-24;
        EXPECT_NEAR(g.x.v, 8 * da * s, tolerance);
        EXPECT_NEAR(g.y.v, 8 * db * s, tolerance);
      }
    }
  }
}

// The published angle is off by up to 19.7 degrees where s = T and 14.3 where s = T / 2.
TEST(EdgeSplashGradient, PublishedAngleErrorOnRamps) {
  const auto worst = [](double s, double thickness) {
    double most = 0;
    for (int k = 0; k < 36000; ++k) {
      const double t = 2 * pi * k / 36000, a = std::cos(t), b = std::sin(t);
      const double gx = 8 * a * s - 2 * b * s, gy = 4 * b * s + 2 * b * thickness;
      const double off = std::atan2(gy, gx) - t;
      most = std::max(most, std::abs(std::remainder(off, 2 * pi)));
    }
    return most * 180 / pi;
  };
  EXPECT_NEAR(worst(1, 1), 19.7, 0.1);
  EXPECT_NEAR(worst(0.5, 1), 14.3, 0.1);
  EXPECT_NEAR(worst(0.1, 1), 33.8, 0.1);
  // The closed form is the pass's own (above); the pass itself at s = T, by whole grains in 400 directions.
  double most = 0;
  for (int k = 0; k < 400; ++k) {
    const double t = 2 * pi * k / 400, a = std::round(512 * std::cos(t)), b = std::round(512 * std::sin(t));
    const Field ramp(16, 16, Address::border, [&](int x, int y) { return 1 + 0x1p-16 * (a * (x - 8) + b * (y - 8)); });
    const auto g = published_gradient<D>(3, ramp, 8, 8);
    most = std::max(most, std::abs(std::remainder(std::atan2(g.y.v, g.x.v) - std::atan2(b, a), 2 * pi)));
  }
  EXPECT_NEAR(most * 180 / pi, 19.7, 0.2);
}

// |g| = 4 D across a straight step; area-sampled steps at an angle give the tabulated figures.
TEST(EdgeSplashGradient, CorrectedSumsOfAStep) {
  struct Row {
    double degrees, ratio;
  };
  const double height = 2, nearest = 3;
  for (const Row row : {Row{0, 4.000}, Row{15, 4.141}, Row{30, 4.303}, Row{45, 4.243}}) {
    const double c = std::cos(row.degrees * pi / 180), s = std::sin(row.degrees * pi / 180);
    // The share of a texel beyond the line through the centre of texel (8, 8), from 256 x 256 points: within 1/256.
    const auto share = [&](int x, int y) {
      int beyond = 0;
      for (int j = 0; j < 256; ++j) {
        for (int i = 0; i < 256; ++i) beyond += (x - 8 + (i + 0.5) / 256 - 0.5) * c + (y - 8 + (j + 0.5) / 256 - 0.5) * s > 0;
      }
      return beyond / 65536.0;
    };
    const Field inverse(17, 17, Address::clamp, [&](int x, int y) {
      return std::abs(x - 8) > 1 || std::abs(y - 8) > 1 ? 1.0 : 1 / (nearest + height * share(x, y));
    });
    const auto g = corrected_gradient<D>(1, inverse, 8, 8);
    EXPECT_NEAR(std::hypot(g.x.v, g.y.v) / height, row.ratio, 4e-3) << row.degrees;
    EXPECT_NEAR(std::atan2(g.y.v, g.x.v) * 180 / pi, row.degrees, 1.4);  // centred: at most 1.4 degrees
  }
}

TEST(EdgeSplashGradient, ConstantDepthHasNone) {
  // A dyadic depth: multiples of it add without rounding.
  const Field flat(32, 32, Address::border, [](int, int) { return 0.375; });
  const auto g = published_gradient<F>(3, flat, 16, 16);
  EXPECT_EQ(g.x.v, 0);
  EXPECT_EQ(g.y.v, 0);
  const auto c = corrected_gradient<F>(2, Field(32, 32, Address::clamp, [](int, int) { return 0.3; }), 16, 16);
  EXPECT_EQ(c.x.v, 0);
  EXPECT_EQ(c.y.v, 0);
}

// 1 / z is affine over the picture of a plane: no bend, however steeply it recedes.
TEST(EdgeSplashGradient, APlaneHasNoBend) {
  SplashUniforms u{};
  u.depth_scale = 1;
  u.reach_min = u.reach_max = 4;
  const Field ground(64, 64, Address::clamp, [](int x, int y) { return 0.5 - 0.0075 * y + 0.001 * x; });
  for (int y = 8; y < 56; y += 8) {
    const auto bend = scalar::bend_of(scalar::taps_corrected<D>(u, ground.view(), D(32.0f), D(static_cast<float>(y))));
    EXPECT_LT(bend.v, 4 * 0x1p-24 * 0.5 / 0.08) << y;  // four stored inverses, half an ulp of at most 1/2 each, over the smallest
  }
  // At a step the bend is 1 - zn / zf.
  const Field step(64, 64, Address::clamp, [](int, int y) { return y < 32 ? 1 / 2.0 : 1 / 5.0; });
  EXPECT_NEAR(scalar::bend_of(scalar::taps_corrected<D>(u, step.view(), D(32.0f), D(30.0f))).v, 1 - 2.0 / 5, 1e-6);
}

}  // namespace
}  // namespace rainref::edge_splash
