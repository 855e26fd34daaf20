// Corrected raindrops: how many, where, how large, and the energy of the crater each leaves.
#include <algorithm>

#include "puddle/rainfall.h"
#include "puddle/scene_support.h"
#include "rain/rain.h"
#include "random/statistics.h"

namespace rainref::puddle::test {
namespace {

Settings raining(double rate, double smallest) {
  Settings s = corrected(1, 1);
  s.rain_rate = rate;
  s.smallest_drop = smallest;
  return s;
}

TEST(PuddleRainfall, CraterHoldsAHundredthOfTheImpact) {
  // rho g / 2 times the integral of h^2 against 1 % of rho pi D^3 / 6 * v^2 / 2; density cancels. Midpoint rule in the
  // crater of the pass itself, 400 cells to the radius: error O(1e-5).
  constexpr double gravity = 9.80665;
  for (const auto& [diameter, speed] : {std::pair{1e-3, 4.03}, {2e-3, 6.49}, {5e-3, 9.09}}) {
    const double radius = 7 * diameter, depth = crater_depth(diameter, speed, radius);
    constexpr int n = 400;
    const Drop drop{0, 0, static_cast<float>(-depth), static_cast<float>(radius)};
    double squares = 0, volume = 0;
    for (int y = -n; y < n; ++y) {
      for (int x = -n; x < n; ++x) {
        const double h = scalar::drop_corrected(drop, Double((x + 0.5) / n * radius), Double((y + 0.5) / n * radius)).v;
        squares += h * h;
        volume += h;
      }
    }
    const double cell = radius / n * (radius / n);
    EXPECT_NEAR(0.5 * gravity * squares * cell / (0.01 * pi / 6 * diameter * diameter * diameter * speed * speed / 2), 1, 1e-4);
    EXPECT_NEAR(volume * cell / (depth * pi * radius * radius), 0, 1e-6);
  }
}

TEST(PuddleRainfall, CratersOfTheSizeClasses) {
  const Settings s = raining(20, 0.5);
  const Rainfall rain(s, 1);
  const std::vector<double> diameters = rain::DropSizes(20, 0.5).quantiles(Rainfall::sizes);
  for (int k = 0; k < Rainfall::sizes; ++k) {
    const double d = diameters[static_cast<std::size_t>(k)], radius = std::max(7e-3 * d, 3 * s.cell_size);
    EXPECT_NEAR(rain.crater(k).radius, radius / s.cell_size, 1e-6 * radius / s.cell_size) << k;
    const double depth = crater_depth(d * 1e-3, rain::terminal_velocity(d), radius);
    EXPECT_NEAR(rain.crater(k).amplitude, -depth, 1e-6 * depth) << k;
  }
  // Intensity scales the depth and nothing else.
  Settings strong = s;
  strong.drop_intensity = 3;
  EXPECT_FLOAT_EQ(Rainfall(strong, 1).crater(500).amplitude, 3 * rain.crater(500).amplitude);
  EXPECT_EQ(Rainfall(strong, 1).crater(500).radius, rain.crater(500).radius);
}

TEST(PuddleRainfall, CountsArePoissonWithTheFluxOfTheRain) {
  Settings s = raining(30, 0.2);
  s.boundary = Boundary::fixed;  // without images of drops beyond the edges
  const Rainfall rain(s, 1);
  const double mean = rain::DropSizes(30, 0.2).flux() * 0.8 * 0.6 / s.step_rate;
  EXPECT_NEAR(rain.mean(), mean, 1e-12 * mean);
  constexpr int steps = 4000;
  double sum = 0, squares = 0, x = 0, y = 0;
  for (int k = 0; k < steps; ++k) {
    const std::vector<Drop> drops = rain.drops(k);
    const double n = static_cast<double>(drops.size());
    sum += n;
    squares += n * n;
    for (const Drop& d : drops) {
      ASSERT_TRUE(0 <= d.x && d.x < 40 && 0 <= d.y && d.y < 30);
      ASSERT_EQ(d.x * 256, std::floor(d.x * 256)) << "multiples of 1/256 texel";
      x += d.x;
      y += d.y;
    }
  }
  // Four standard deviations: of the mean sqrt(m / N), of the ratio of variance to mean sqrt(2 / N), of uniform places.
  EXPECT_NEAR(sum / steps, mean, 4 * std::sqrt(mean / steps));
  EXPECT_NEAR((squares / steps - sum / steps * (sum / steps)) / (sum / steps), 1, 4 * std::sqrt(2.0 / steps));
  EXPECT_NEAR(x / sum, 20, 4 * 40 / std::sqrt(12 * sum));
  EXPECT_NEAR(y / sum, 15, 4 * 30 / std::sqrt(12 * sum));
}

/// Counts of points of the unit square in a 10 x 10 grid are those of a fair generator: places along a diagonal, or on few columns, are
/// not.
void expect_uniform(const std::vector<int>& cells, const char* what) {
  const double chi = rainref::test::chi_square(cells);
  EXPECT_GT(chi, rainref::test::chi_square_99_low) << what;
  EXPECT_LT(chi, rainref::test::chi_square_99_high) << what;
}

// x, y and size are drawn from words of their own: no two of them know of each other.
TEST(PuddleRainfall, PlacesAndSizesAreIndependentAndUniform) {
  Settings s = raining(30, 0.2);
  s.boundary = Boundary::fixed;
  const Rainfall rain(s, 1);
  std::vector<float> depths;  // of the size classes, equally many drops in each
  for (const Drop& d : rain.craters()) depths.push_back(-d.amplitude);
  ASSERT_TRUE(std::is_sorted(depths.begin(), depths.end()));
  std::vector<int> x_y(100, 0), x_size(100, 0), y_size(100, 0), neighbours(100, 0);
  for (int k = 0; k < 4000; ++k) {
    double before = -1;
    for (const Drop& d : rain.drops(k)) {
      const double x = d.x / 40, y = d.y / 30,
                   size = (static_cast<double>(std::lower_bound(depths.begin(), depths.end(), -d.amplitude) - depths.begin()) + 0.5) /
                          Rainfall::sizes;
      ++x_y[rainref::test::cell_of(x, y)];
      ++x_size[rainref::test::cell_of(x, size)];
      ++y_size[rainref::test::cell_of(y, size)];
      if (before >= 0) ++neighbours[rainref::test::cell_of(before, x)];
      before = x;
    }
  }
  expect_uniform(x_y, "x, y");
  expect_uniform(x_size, "x, size");
  expect_uniform(y_size, "y, size");
  expect_uniform(neighbours, "x of two drops of a step");
}

// The article's hash does as well: ten drops a second, a thousand seconds.
TEST(PuddleRainfall, PublishedPlacesAreUniform) {
  RaindropsUniforms u = raindrops_uniforms(as_published(1280, 720), 0);
  u.rain_speed = 1;
  u.drop_count = 10;
  std::vector<int> cells(100, 0);
  for (int t = 0; t < 1000; ++t) {
    u.time = static_cast<float>(t);
    for (const Drop& d : raindrops_as_published(u)) ++cells[rainref::test::cell_of(d.x / 1280, d.y / 720)];
  }
  expect_uniform(cells, "x, y");
}

// A crater that an edge cuts would take water away; its images bring back what the edge cuts off.
TEST(PuddleRainfall, EdgesTakeNoWaterAway) {
  Settings s = raining(60, 0.2);
  const auto [columns, rows] = s.grid;
  const auto volume = [&, columns = columns, rows = rows](Boundary boundary) {
    s.boundary = boundary;
    const Rainfall rain(s, 1);
    double sum = 0;
    for (int k = 0; k < 400; ++k) {
      const std::vector<Drop> drops = rain.drops(k);
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) sum += scalar::impulse_corrected<scalar::Scalar<double>>(drops, x, y).v;
      }
    }
    return sum;
  };
  // What is left is the rounding of a crater to texels, of either sign.
  const double cut = volume(Boundary::fixed);
  EXPECT_LT(std::abs(volume(Boundary::reflecting)), 0.1 * std::abs(cut));
  EXPECT_LT(std::abs(volume(Boundary::periodic)), 0.1 * std::abs(cut));
}

TEST(PuddleRainfall, NoRainNoDrops) {
  const Rainfall dry(raining(0, 0.5), 1);
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(dry.drops(k).empty());
}

}  // namespace
}  // namespace rainref::puddle::test
