// Rays through the rain behind the glass: the grid finds every drop that a ray meets, once, far ones first.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "truth/falling_rain_index.h"

namespace rainref::truth {
namespace {

using windshield::FallingDropView;

Vec vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::vector<FallingDropView> some_drops(int count, double radius) {
  std::mt19937 words(3);
  const auto unit = [&] { return words() * 0x1p-32; };
  std::vector<FallingDropView> drops;
  for (int i = 0; i < count; ++i) {
    FallingDropView d{};
    d.from = {1 + 4 * unit(), 3 * unit() - 1.5, 2 * unit()};
    d.to = {d.from[0] + 0.4 * unit() - 0.2, d.from[1] + 0.1 * unit(), d.from[2] - 0.3 * unit()};
    d.radius = radius * (0.5 + unit());
    d.time_share = unit();
    d.radiance = {unit(), unit(), unit()};
    drops.push_back(d);
  }
  return drops;
}

TEST(FallingRainIndex, IsWhatAllDropsTogetherAre) {
  const std::vector<FallingDropView> drops = some_drops(600, 0.03);
  const FallingRainIndex index(drops);
  std::mt19937 words(4);
  const auto unit = [&] { return words() * 0x1p-32; };
  int met = 0, open = 0;
  for (int ray = 0; ray < 400; ++ray) {
    const Vec origin(0.5 * unit(), 2 * unit() - 1, 2 * unit()), direction = glm::normalize(Vec(1, unit() - 0.5, 0.6 * unit() - 0.3));
    const double distance = 2 + 4 * unit();
    struct Met {
      double t;
      const FallingDropView* drop;
    };
    std::vector<Met> found;
    bool is_close = false;  // a drop that the ray only just meets or misses
    for (const FallingDropView& d : drops) {
      // The nearest of many spheres along its way.
      double least = 1e9, at = 0;
      for (int k = 0; k <= 1000; ++k) {
        const Vec to = vec(d.from) + k / 1000.0 * (vec(d.to) - vec(d.from)) - origin;
        const double t = glm::dot(to, direction), away = glm::length(to - t * direction);
        if (away < least) least = away, at = t;
      }
      is_close |= std::abs(least - d.radius) < 1e-4 || std::abs(at - distance) < 1e-3 || std::abs(at) < 1e-3;
      if (least < d.radius && at >= 0 && at < distance) found.push_back({at, &d});
    }
    std::sort(found.begin(), found.end(), [](const Met& a, const Met& b) { return a.t > b.t; });
    for (std::size_t i = 1; i < found.size(); ++i) is_close |= found[i - 1].t - found[i].t < 1e-3;
    if (is_close) {
      ++open;
      continue;
    }
    Vec expected(0.5, 0.25, 1);
    for (const Met& m : found) expected += m.drop->time_share * (vec(m.drop->radiance) - expected);
    const Vec seen = index.through(origin, direction, distance, Vec(0.5, 0.25, 1));
    EXPECT_NEAR(glm::length(seen - expected), 0, 1e-12) << ray;
    met += static_cast<int>(found.size());
  }
  EXPECT_GT(met, 150);
  EXPECT_LT(open, 200);
}

TEST(FallingRainIndex, NoDropsChangeNothing) {
  EXPECT_EQ(FallingRainIndex({}).through({0, 0, 0}, {1, 0, 0}, 10, {0.5, 0.25, 1}), Vec(0.5, 0.25, 1));
}

}  // namespace
}  // namespace rainref::truth
