// P6: how fast and how round waves spread.
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

// Nothing is felt outside the cone of one texel a step: those texels keep the very bits of rest. At its edge something is.
void expect_cone(const Settings& s, int steps) {
  const auto [width, height] = wave_size(s);
  const int cx = 20, cy = 33;  // in the second tile of rows, at no multiple of a vector
  Puddle puddle = puddle_of(s);
  const double rest = stored_values(puddle.newest())[0];
  Field impulse(cells_of(s));
  impulse[static_cast<std::size_t>(cy) * width + cx] = 1;
  put(puddle, impulse, Field(impulse.size()));
  for (int n = 1; n <= steps; ++n) {
    puddle.simulate();
    const Field stored = stored_values(puddle.newest());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int distance = std::abs(x - cx) + std::abs(y - cy);
        const double value = stored[static_cast<std::size_t>(y) * width + x];
        if (distance > n) {
          ASSERT_EQ(value, rest) << text(s) << " step " << n << " at " << x << ", " << y;
        } else if (distance == n && n <= 8) {
          // At least C^2n: 2^-8 at the limit, 0.09^8 = 4e-9 below; larger than what any storage here drops.
          ASSERT_NE(value, rest) << text(s) << " step " << n << " at " << x << ", " << y;
        }
      }
    }
  }
}
TEST(WaveFront, NothingIsFeltBeforeTheConeArrives) {
  for (const Format storage : {Format::rg32f, Format::rg16f}) {
    for (Settings s : {as_published(45, 70, 0.98), corrected(45, 70, 0.98, courant_limit), corrected(45, 70, 0.98, 0.5)}) {
      s.storage = storage;
      expect_cone(s, 20);
    }
  }
}

// Crests of a ring from a Gaussian hill at rest: along the axis and along the diagonal, by a parabola through three texels.
struct Crests {
  double axis, diagonal;
};
double crest(const std::vector<double>& ray, int from, int to) {
  const auto top = std::max_element(ray.begin() + from, ray.begin() + to);
  const double left = top[-1], right = top[1];
  return static_cast<double>(top - ray.begin()) + 0.5 * (left - right) / (left - 2 * *top + right);
}
Crests crests(const Puddle& puddle, const Settings& s, int centre, int n) {
  const Field u = heights(puddle.newest(), s);
  const int width = wave_size(s)[0];
  std::vector<double> axis, diagonal;
  for (int r = 0; r <= centre; ++r) {
    axis.push_back(u[static_cast<std::size_t>(centre) * width + centre + r]);
    diagonal.push_back(u[static_cast<std::size_t>(centre + r) * width + centre + r]);
  }
  const double expected = n * std::sqrt(0.5);
  const auto around = [&](const std::vector<double>& ray, double r) {
    return crest(ray, static_cast<int>(r) - 15, static_cast<int>(r) + 15);
  };
  return {around(axis, expected), std::sqrt(2.0) * around(diagonal, expected / std::sqrt(2.0))};
}

TEST(WaveFront, RingsAreAsFastAndAsRoundAsTheTable) {
  const struct {
    double sigma, axis, diagonal, roundness;
  } table[] = {{2, .9954, 1.0001, .992}, {4, .9970, 1.0003, .9966}, {8, 1.0001, 1.0011, .9990}};
  const int size = 385, centre = 192;
  for (const Variant variant : variants) {
    const Settings s = variant == Variant::as_published ? as_published(size, size, 1) : corrected(size, size, 1, courant_limit);
    for (const auto& row : table) {
      const Field hill = make_field(size, size, [&](int x, int y) {
        return std::exp(-((x - centre) * (x - centre) + (y - centre) * (y - centre)) / (2 * row.sigma * row.sigma));
      });
      Puddle puddle = puddle_of(s);
      put(puddle, hill, hill);
      for (int n = 0; n < 100; ++n) puddle.simulate();
      const Crests first = crests(puddle, s, centre, 100);
      for (int n = 0; n < 100; ++n) puddle.simulate();
      const Crests last = crests(puddle, s, centre, 200);
      const double axis = (last.axis - first.axis) / 100 * std::sqrt(2.0),
                   diagonal = (last.diagonal - first.diagonal) / 100 * std::sqrt(2.0);
      const std::string key = fmt::format("{} sigma {}", text(s), row.sigma);
      record(key + " axis", axis);
      record(key + " diagonal", diagonal);
      record(key + " roundness", last.axis / last.diagonal);
      // Parabola and interval of steps move the table's figures by 4e-4.
      EXPECT_NEAR(axis, row.axis, 6e-4) << key;
      EXPECT_NEAR(diagonal, row.diagonal, 6e-4) << key;
      EXPECT_NEAR(last.axis / last.diagonal, row.roundness, 6e-4) << key;
    }
  }
}

}  // namespace
}  // namespace rainref::puddle
