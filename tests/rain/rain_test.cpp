// Drop sizes and speeds are those of Marshall and Palmer and of Gunn and Kinzer's table.
#include "rain/rain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error_of.h"

namespace rainref::rain {
namespace {

// R. Gunn and G. D. Kinzer, J. Meteor. 6 (1949): diameter [mm], velocity [m/s].
constexpr double gunn_kinzer[][2] = {{.1, .27},   {.2, .72},   {.3, 1.17},  {.4, 1.62},  {.5, 2.06},  {.6, 2.47},  {.7, 2.87},
                                     {.8, 3.27},  {.9, 3.67},  {1.0, 4.03}, {1.2, 4.64}, {1.4, 5.17}, {1.6, 5.65}, {1.8, 6.09},
                                     {2.0, 6.49}, {2.2, 6.90}, {2.4, 7.27}, {2.6, 7.57}, {2.8, 7.82}, {3.0, 8.06}, {3.2, 8.26},
                                     {3.4, 8.44}, {3.6, 8.60}, {3.8, 8.72}, {4.0, 8.83}, {4.2, 8.92}, {4.4, 8.98}, {4.6, 9.03},
                                     {4.8, 9.07}, {5.0, 9.09}, {5.2, 9.12}, {5.4, 9.14}, {5.6, 9.16}, {5.8, 9.17}};

/// Integral of f over [a, b] by Simpson's rule.
template <class F>
double integral(double a, double b, F f) {
  constexpr int n = 24000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * f(a + (b - a) * i / n);
  return sum * (b - a) / (3 * n);
}
/// Arrivals [1/m^2/s/mm] by the published formulas.
double arrivals(double rate, double d) { return 8000 * std::exp(-4.1 * std::pow(rate, -0.21) * d) * terminal_velocity(d); }

TEST(TerminalVelocity, IsTheTableAndLinearBetween) {
  double d0 = 0, v0 = 0;
  for (const auto& [d, v] : gunn_kinzer) {
    EXPECT_DOUBLE_EQ(terminal_velocity(d), v);
    EXPECT_NEAR(terminal_velocity(0.75 * d0 + 0.25 * d), 0.75 * v0 + 0.25 * v, 1e-12);
    d0 = d;
    v0 = v;
  }
}

TEST(TerminalVelocity, IsZeroWithoutADropAndConstantBeyondTheTable) {
  EXPECT_EQ(terminal_velocity(0), 0);
  EXPECT_EQ(terminal_velocity(-1), 0);
  EXPECT_EQ(terminal_velocity(5.9), 9.17);
  EXPECT_EQ(terminal_velocity(100), 9.17);
}

// Atlas, Srivastava and Sekhon 1973 fit the same measurements to 0.163 m/s from 0.6 to 5.8 mm.
TEST(TerminalVelocity, AgreesWithTheFitOfAtlas) {
  for (double d = 0.6; d <= 5.8; d += 0.01) EXPECT_NEAR(terminal_velocity(d), 9.65 - 10.3 * std::exp(-0.6 * d), 0.17) << d;
}

TEST(DropSizes, LambdaIsThatOfMarshallAndPalmer) {
  const double table[][2] = {{1, 4.100}, {5, 2.924}, {10, 2.528}, {25, 2.086}, {50, 1.803}, {100, 1.559}};
  for (const auto& [rate, lambda] : table) {
    EXPECT_NEAR(DropSizes(rate, 0).lambda(), lambda, 0.0005) << rate;
    EXPECT_NEAR(DropSizes(rate, 0).lambda(), 4.1 * std::pow(rate, -0.21), 1e-12) << rate;
  }
}

/// What f(D) sums up to from 6 to 8 mm, which the tables include and DropSizes leaves out: drops of that size break up.
template <class F>
double beyond_the_largest(double rate, F f) {
  return integral(DropSizes::largest_mm, 8, [&](double d) { return arrivals(rate, d) * f(d); });
}
double water_of(double d) { return 3.14159265358979323846 / 6 * d * d * d * 1e-6 * 3600; }

TEST(DropSizes, FluxIsTheTableOfAllDropsAndOfThoseOverHalfAMillimetre) {
  const double table[][3] = {{1, 1811, 754}, {5, 3600, 2106}, {10, 4802, 3115}, {25, 6971, 5035}, {50, 9185, 7068}, {100, 12035, 9745}};
  for (const auto& [rate, all, large] : table) {
    const double beyond = beyond_the_largest(rate, [](double) { return 1; });
    EXPECT_NEAR(DropSizes(rate, 0).flux() + beyond, all, 0.5) << rate;
    EXPECT_NEAR(DropSizes(rate, 0.5).flux() + beyond, large, 0.5) << rate;
    EXPECT_LT(beyond, 5e-4 * all);
  }
}

TEST(DropSizes, FluxIsTheIntegralOfTheFormulas) {
  for (const double rate : {0.1, 1.0, 17.0, 100.0, 1000.0}) {
    for (const double smallest : {0.0, 0.35, 0.5, 2.0, 5.9}) {
      const double exact = integral(smallest, DropSizes::largest_mm, [&](double d) { return arrivals(rate, d); });
      EXPECT_NEAR(DropSizes(rate, smallest).flux() / exact, 1, 2e-6) << rate << ' ' << smallest;
    }
  }
}

// N(D) = N(0) exp(-Lambda D), whose integral from D on is N(D) / Lambda.
TEST(DropSizes, NumberIsTheFormulaAndInAirItsIntegral) {
  for (const double rate : {1.0, 20.0, 100.0}) {
    const DropSizes drops(rate, 0.5);
    EXPECT_EQ(drops.number(0), 8000);
    for (const double d : {0.5, 1.0, 3.0}) {
      EXPECT_NEAR(drops.number(d), 8000 * std::exp(-drops.lambda() * d), 1e-9);  // a few units in the last place of 8000
      EXPECT_NEAR(drops.in_air(d), drops.number(d) / drops.lambda(), 1e-9);
    }
  }
  EXPECT_EQ(DropSizes(0, 0.5).number(1), 0);
}

TEST(DropSizes, WaterIsAboveTheRateByTheKnownAmount) {
  const double table[][3] = {{1, 1.18, .005}, {5, 5.90, .005}, {10, 11.64, .005}, {25, 28.3, .05}, {50, 54.8, .05}, {100, 105.1, .05}};
  for (const auto& [rate, water, digits] : table) {
    const DropSizes drops(rate, 0);
    EXPECT_NEAR(integral(0, 8, [&](double d) { return drops.number(d) * terminal_velocity(d) * water_of(d); }), water, digits) << rate;
  }
}

TEST(DropSizes, QuantilesCutTheArrivalsIntoEqualParts) {
  for (const double rate : {0.5, 10.0, 100.0}) {
    for (const double smallest : {0.0, 0.5, 3.0}) {
      const DropSizes sizes(rate, smallest);
      const std::vector<double> q = sizes.quantiles(64);
      ASSERT_EQ(q.size(), 64u);
      double before = smallest, sum = 0;
      for (std::size_t i = 0; i < q.size(); ++i) {
        ASSERT_GT(q[i], before);
        sum += integral(before, q[i], [&](double d) { return arrivals(rate, d); });
        EXPECT_NEAR(sum / sizes.flux(), (static_cast<double>(i) + 0.5) / 64, 3e-6) << rate << ' ' << smallest << ' ' << i;
        before = q[i];
      }
      EXPECT_LT(before, DropSizes::largest_mm);
    }
  }
}

TEST(DropSizes, OneQuantileIsTheMedian) {
  const DropSizes sizes(10, 0);
  const double median = sizes.quantiles(1).at(0);
  EXPECT_NEAR(integral(0, median, [](double d) { return arrivals(10, d); }) / sizes.flux(), 0.5, 1e-6);
  EXPECT_TRUE(sizes.quantiles(0).empty());
}

// 1024 classes stand for the distribution: their mean diameter is that of the drops that arrive.
TEST(DropSizes, ManyQuantilesKeepTheMean) {
  const DropSizes sizes(25, 0);
  const std::vector<double> q = sizes.quantiles(1024);
  double mean = 0;
  for (const double d : q) mean += d / 1024;
  const double exact =
      integral(0, 6, [](double d) { return d * arrivals(25, d); }) / integral(0, 6, [](double d) { return arrivals(25, d); });
  EXPECT_NEAR(mean, exact, 1e-3 * exact);
}

TEST(DropSizes, WithoutRainThereIsNothing) {
  const DropSizes none(0, 0.5);
  EXPECT_EQ(none.flux(), 0);
  EXPECT_TRUE(none.quantiles(8).empty());
}

TEST(DropSizes, RefusesWhatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [rate, smallest] : {std::pair{-1.0, 0.0}, {1000.1, 0.0}, {nan, 0.0}, {1.0, -0.1}, {1.0, 6.0}, {1.0, nan}}) {
    const std::string error = error_of([rate = rate, smallest = smallest] { const DropSizes sizes(rate, smallest); });
    EXPECT_TRUE(error.starts_with("2 ") && error.find("expected a rate from 0 to 1000 and a diameter from 0 to 6") != std::string::npos)
        << rate << ' ' << smallest << ": " << error;
  }
}

}  // namespace
}  // namespace rainref::rain
