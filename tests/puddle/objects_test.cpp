// Objects that move through the water: what their records say, and the waves that theory has for a pressure that moves.
#include "puddle/objects.h"

#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "puddle/scene_support.h"
#include "rainref/error.h"

namespace rainref::puddle::test {
namespace {

using testing::HasSubstr;

/// A lossless basin of n x n cells of 1 cm, waves of 1/2 m/s at C = 1/2, without rain, and this object.
Settings still_water(int n, const std::string& objects) {
  Settings s = corrected(8, 8);
  s.grid = {n, n};
  s.cell_size = 0.01;
  s.wave_speed = 0.5;
  s.step_rate = 100;
  s.fps = 100;
  s.damping = 1;
  s.storage = Format::rg32f;
  s.shape = Shape::basin;
  s.rain_rate = 0;
  s.objects = objects;
  return s;
}
/// Heights, row-major [m].
std::vector<double> heights(const Puddle& p) {
  std::vector<double> out;
  for (int y = 0; y < p.newest().height(); ++y)
    for (int x = 0; x < p.newest().width(); ++x) out.push_back(p.newest().row<float>(y)[x]);
  return out;
}
Puddle after(const Settings& s, int frames) {
  static const parallel::Executor two(2);
  Puddle p(s, uniform_surroundings(1, 0.5), two);
  for (int n = 0; n < frames; ++n) p.simulate();
  return p;
}

TEST(PuddleObjects, RestBeforeAndAfterAndGoEvenlyBetween) {
  const std::vector<MovingObject> objects = parse_objects("0.04 0.002: 1 -0.3 0.1, 2 0.3 0.1, 4 0.3 -0.3; 0.1 -1: 0 5 6;");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].radius, 0.04);
  EXPECT_EQ(objects[1].depth, -1);
  const auto at = [&](double t) { return std::pair{objects[0].at(t).x, objects[0].at(t).z}; };
  EXPECT_EQ(at(-5), std::pair(-0.3, 0.1));
  EXPECT_EQ(at(1), std::pair(-0.3, 0.1));
  EXPECT_NEAR(at(1.25).first, -0.15, 1e-15);
  EXPECT_NEAR(at(3).second, -0.1, 1e-15);
  EXPECT_EQ(at(9), std::pair(0.3, -0.3));
  EXPECT_EQ(objects[1].at(100).x, 5);
}
TEST(PuddleObjects, WhatIsNoListOfThemIsRefused) {
  const auto message = [](const std::string& text) { return error_of([&] { parse_objects(text); }); };
  EXPECT_EQ(message(""), "none");
  EXPECT_THAT(message("0.1 0.1"), HasSubstr("2 puddle.objects, object 1: expected \"radius depth: time x z, ...\""));
  EXPECT_THAT(message("0.1: 0 0 0"), HasSubstr("expected \"radius depth\", found '0.1'"));
  EXPECT_THAT(message("0.1 0.1: 0 0"), HasSubstr("expected \"time x z\", found '0 0'"));
  EXPECT_THAT(message("0.1 0.1: 0 0 0; 0 0.1: 0 0 0"), HasSubstr("object 2: radius"));
  EXPECT_THAT(message("0.1 0.1: 0 0 0, 0 1 1"), HasSubstr("expected more than 0 of the place before"));
  EXPECT_THAT(message("0.1 x: 0 0 0"), HasSubstr("found 'x'"));
  EXPECT_THAT(message("0.1 1e3: 0 0 0"), HasSubstr("depth"));
  EXPECT_THAT(message("0.1 1: 0 1e9 0"), HasSubstr("place"));
}

// The head that a step leaves is the one that the step before put there, to the bit; where it rests there is no record.
TEST(PuddleObjects, RecordsTakeTheHeadAlong) {
  const Settings s = still_water(60, "0.05 0.002: 0.1 -0.1 0.02, 0.3 0.13 0.05");
  const Objects objects(s, 1);
  EXPECT_TRUE(objects.records(0).empty());
  EXPECT_TRUE(objects.records(9).empty());
  Drop last{};
  for (int step = 10; step < 30; ++step) {
    const std::vector<Drop> records = objects.records(step);
    ASSERT_EQ(records.size(), 2U);
    EXPECT_FLOAT_EQ(records[0].amplitude, -0.002f);
    EXPECT_FLOAT_EQ(records[1].amplitude, 0.002f);
    EXPECT_FLOAT_EQ(records[1].radius, 5);
    const double share = (step + 1 - 10) / 20.0;
    EXPECT_NEAR(records[1].x, 30 + 100 * (-0.1 + 0.23 * share), 0.5 / 1024 + 1e-9);
    EXPECT_NEAR(records[1].y, 30 + 100 * (0.02 + 0.03 * share), 0.5 / 1024 + 1e-9);
    if (step > 10) {
      EXPECT_EQ(records[0].x, last.x);
      EXPECT_EQ(records[0].y, last.y);
    }
    last = records[1];
  }
  EXPECT_TRUE(objects.records(30).empty());
  // At a wall with its mirror image, beyond the water none.
  EXPECT_EQ(Objects(still_water(60, "0.05 0.002: 0 -0.28 0, 1 -0.28 0.1"), 1).records(0).size(), 4U);
  EXPECT_TRUE(Objects(still_water(60, "0.05 0.002: 0 -0.36 0, 1 -0.36 0.1"), 1).records(0).empty());
}

// A crater's volume is 0 on the plane. On the grid a sum over cells of it is that integral but for the rings of the polynomial's edge,
// whose third derivative jumps.
TEST(PuddleObjects, KeepTheMean) {
  const Settings s = still_water(64, "0.06 0.01: 0 -0.2 -0.1, 1 0.2 0.15; 0.05 0.02: 0.2 0 0.3, 0.7 0.1 0.05");
  const Puddle p = after(s, 150);
  double sum = 0, largest = 0;
  for (const double h : heights(p)) {
    sum += h;
    largest = std::max(largest, std::abs(h));
  }
  EXPECT_GT(largest, 1e-4);
  // Of 150 steps each may leave the difference of two such sums: 1e-4 of a cell's head for a radius of five cells.
  EXPECT_NEAR(sum / (64 * 64), 0, 1e-6 * largest) << largest;
}
TEST(PuddleObjects, OneThatRestsLeavesTheWaterLevel) {
  for (const double h : heights(after(still_water(32, "0.05 0.01: 0 0.02 0.03"), 20))) ASSERT_EQ(h, 0);
}

// v_tt = c^2 lap(v + head), u = v + head. In a steady frame that goes with speed M c, for a head f with transform F: U = -F M^2 k_x^2 /
// (k^2
// - M^2 k_x^2). In the middle of a round one its mean over directions: u(0) = -f(0) (1 / sqrt(1 - M^2) - 1).
TEST(PuddleObjects, ASlowOneHasTheSteadyWaterOfTheory) {
  for (const double mach : {0.3, 0.5, 0.7}) {
    constexpr int n = 400;
    const double speed = mach * 0.5, radius = 0.16, head = 0.01;
    // It comes to speed in one step, whose ring is 0.5 m/s times 3.6 s away when it is looked at, and has not come back from a wall.
    const double time = 3.6, from = -0.5 * speed * time;
    const Settings s = still_water(n, fmt::format("{} {}: 0 {} 0, 10 {} 0", radius, head, from, from + 10 * speed));
    const Puddle p = after(s, static_cast<int>(time * s.fps));
    const std::vector<double> h = heights(p);
    const double x = from + speed * time;  // = -from
    const auto at = [&](double dx, double dz) {
      const int column = static_cast<int>(std::floor((x + dx) / 0.01 + 0.5 * n)), row = static_cast<int>(std::floor(dz / 0.01 + 0.5 * n));
      return h[static_cast<std::size_t>(row * n + column)];
    };
    const double expected = -head * (1 / std::sqrt(1 - mach * mach) - 1);
    // Sixteen cells to the radius; the scheme's shortest waves are slower by some per cent. The tail of the start decays as 1 / t.
    EXPECT_NEAR(at(0, 0), expected, 0.06 * std::abs(expected) + 0.01 * head) << mach;
    // As high before it as behind it, and level far from it: no wake.
    for (const double d : {0.1, 0.2, 0.3}) EXPECT_NEAR(at(d, 0), at(-d, 0), 0.02 * head) << mach << ' ' << d;
    double behind = 0;
    for (double d = 0.4; d < 0.6; d += 0.01)
      for (double z = -0.3; z < 0.3; z += 0.01) behind = std::max(behind, std::abs(at(-d, z)));
    EXPECT_LT(behind, 0.02 * head) << mach;
  }
}

// Faster than the waves: nothing outside of asin(1 / M) behind it, and the wake's front on that line.
TEST(PuddleObjects, AFastOneDrawsAWakeWithinTheAngleOfMach) {
  for (const double mach : {1.5, 2.0, 3.0}) {
    constexpr int n = 400;
    const double speed = mach * 0.5, radius = 0.08, head = 0.01, time = 3 / speed;
    const Settings s = still_water(n, fmt::format("{} {}: 0 -1.5 0, 10 {} 0", radius, head, -1.5 + 10 * speed));
    const int frames = static_cast<int>(time * s.fps);
    const std::vector<double> h = heights(after(s, frames));
    const double x = -1.5 + speed * frames / s.fps, tangent = std::tan(std::asin(1 / mach)), cosine = std::cos(std::asin(1 / mach));
    const auto at = [&](int column, int row) { return h[static_cast<std::size_t>(row * n + column)]; };
    double outside = 0, on_front = 0;
    std::vector<double> far, tallest;  // behind it, and where the wake is tallest beside its way
    for (int column = 0; column < n; ++column) {
      const double behind = x - ((column + 0.5) * 0.01 - 0.5 * n * 0.01);
      double most = 0, at_most = 0;
      for (int row = n / 2; row < n; ++row) {
        const double beside = (row + 0.5) * 0.01 - 0.5 * n * 0.01;
        // Distance from the Mach line, outward; the object's own radius lies before it.
        const double out = (beside - behind * tangent) * cosine, u = std::abs(at(column, row));
        if (out > 1.2 * radius) outside = std::max(outside, u);
        if (std::abs(out) < radius) on_front = std::max(on_front, u);
        if (u > most) {
          most = u;
          at_most = beside;
        }
      }
      // Away from the object and from the ring of its start.
      if (behind > 4 * radius && behind < 1.0) {
        far.push_back(behind);
        tallest.push_back(at_most);
      }
    }
    EXPECT_LT(outside, 0.02 * on_front) << mach;
    EXPECT_GT(on_front, 0.1 * head) << mach;
    // The slope of the tallest line over the way behind: the tangent of the angle.
    const auto count = static_cast<double>(far.size());
    const double mean_x = std::accumulate(far.begin(), far.end(), 0.0) / count,
                 mean_y = std::accumulate(tallest.begin(), tallest.end(), 0.0) / count;
    double xy = 0, xx = 0;
    for (std::size_t k = 0; k < far.size(); ++k) {
      xy += (far[k] - mean_x) * (tallest[k] - mean_y);
      xx += (far[k] - mean_x) * (far[k] - mean_x);
    }
    EXPECT_NEAR(std::atan(xy / xx), std::asin(1 / mach), 0.03) << mach << ": within two degrees";
  }
}

}  // namespace
}  // namespace rainref::puddle::test
