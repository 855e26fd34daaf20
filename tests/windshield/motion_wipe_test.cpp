// Pass wipe_drops, corrected: drops ride ahead of the blade, none is left behind it (physics: W11).
#include <gtest/gtest.h>

#include "image/images.h"
#include "windshield/sweep_geometry.h"

namespace rainref::windshield {
namespace {

// Captured drops keep their radius, stand half_width and their own radius ahead of the blade, and move with it.
TEST(MotionWipe, CapturedDropsRideAheadOfTheBlade) {
  const WiperSettings s = inner_blade();
  for (const double start : {0.2, 0.7}) {  // forth and back
    const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), start, start + 1.0 / 60, corrected);
    DropArrays drops = random_drops(20000, 4);
    const DropArrays before = drops;
    Image film(Format::r32f, 8, 8);
    EXPECT_EQ(wipe(drops, records, film), 0u);
    const Wiper& w = records[0];
    const double rate = w.rate, angle = std::atan2(w.axis[1], w.axis[0]);
    int captured = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const Point was = in_plane(before, i), is = in_plane(drops, i);
      const bool inside = before.life[i] > 0 && sweep_distance(w, was) <= s.half_width;
      const bool near_outline = std::abs(sweep_distance(w, was) - s.half_width) < 1e-6;
      if (near_outline) continue;
      if (!inside) {
        EXPECT_EQ(drops.u[i], before.u[i]);
        EXPECT_EQ(drops.velocity_v[i], before.velocity_v[i]);
        continue;
      }
      ++captured;
      const double rx = is.x - w.pivot[0], ry = is.y - w.pivot[1];
      const double a = radius_scale * std::cbrt(before.mass[i]);
      EXPECT_NEAR(std::hypot(rx, ry), std::hypot(was.x - w.pivot[0], was.y - w.pivot[1]), 1e-6);
      EXPECT_NEAR(w.direction * (std::cos(angle) * ry - std::sin(angle) * rx), s.half_width + a, 1e-6);
      const Real2 velocity = default_glass().plane().to_plane({drops.velocity_u[i], drops.velocity_v[i]});
      EXPECT_NEAR(velocity[0], -rate * ry, 2e-6);
      EXPECT_NEAR(velocity[1], rate * rx, 2e-6);
      EXPECT_EQ(drops.mass[i], before.mass[i]);
      EXPECT_EQ(drops.life[i], before.life[i]);
    }
    EXPECT_GT(captured, 100);
  }
}

// Many steps at many speeds, drops drifting all the time: after each step no live drop lies strictly inside what was
// swept in it.
TEST(MotionWipe, NoLiveDropIsLeftInAFreshSweep) {
  for (const char* arrangement : {"tandem", "opposed"}) {
    for (const double cycles_per_minute : {20.0, 45.0, 65.0, 300.0}) {
      WiperSettings s = default_wipers(default_glass(), arrangement);
      s.cycles_per_minute = cycles_per_minute;
      DropArrays drops = random_drops(3000, 5);
      Image film(Format::r32f, 16, 16);
      std::mt19937 random(6);
      std::uniform_real_distribution<float> unit(-0.5f, 0.5f);
      std::uint64_t removed = 0;
      for (int n = 0; n < 100; ++n) {
        const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), n / 60.0, (n + 1) / 60.0, corrected);
        removed += wipe(drops, records, film);
        for (std::size_t i = 0; i < drops.size(); ++i) {
          if (!(drops.life[i] > 0)) continue;
          for (const Wiper& w : records) {
            if (w.direction == 0) continue;
            ASSERT_GE(sweep_distance(w, in_plane(drops, i)), s.half_width - 2e-7) << arrangement << " " << cycles_per_minute << " " << n;
          }
          drops.u[i] += 0.02f * unit(random);
          drops.v[i] += 0.02f * unit(random);
        }
      }
      const auto live = std::count_if(drops.life.begin(), drops.life.end(), [](float life) { return life > 0; });
      EXPECT_GT(live, 2000) << arrangement;
      if (std::string(arrangement) == "tandem") {
        EXPECT_EQ(removed, 0u) << "parallel blades squeeze nothing";
      }
    }
  }
}

// Two blades that turn through each other: each pushes drops into the sweep of the other. What finds no place is thrown
// off, and counted.
TEST(MotionWipe, DropsBetweenBladesThatMeetAreThrownOff) {
  WiperSettings s;
  s.blades = {{{0.6, -0.06}, 0.16, 0.6, 100 * degree, -40 * degree, 0}, {{0.8, -0.06}, 0.16, 0.6, 80 * degree, 40 * degree, 0}};
  s.cycles_per_minute = 60;
  const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), 0, 0.5, corrected);
  DropArrays drops = random_drops(5000, 12);
  const DropArrays before = drops;
  Image film(Format::r32f, 16, 16);
  const std::uint64_t removed = wipe(drops, records, film);
  std::uint64_t thrown = 0;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    if (drops.life[i] > 0) {
      for (const Wiper& w : records) ASSERT_GE(sweep_distance(w, in_plane(drops, i)), s.half_width - 2e-7);
    } else if (before.life[i] > 0) {
      thrown += static_cast<std::uint64_t>(before.mass[i]);
    }
  }
  EXPECT_GT(thrown, 0u);
  EXPECT_EQ(removed, thrown);
}

// One stroke over N uniform drops: 1 - swept / glass of them are where they were, within 4 standard deviations.
TEST(MotionWipe, AStrokeLeavesTheUnsweptShare) {
  for (const double fps : {24.0, 60.0}) {
    const WiperSettings s = inner_blade(60);
    const Blade& b = s.blades[0];
    DropArrays drops(40000);
    std::mt19937 random(8);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::size_t i = 0; i < drops.size(); ++i) {
      drops.u[i] = unit(random);
      drops.v[i] = unit(random);
      drops.mass[i] = 50000;
    }
    const DropArrays before = drops;
    Image film(Format::r32f, 4, 4);
    for (int n = 0; n < fps / 2; ++n) wipe(drops, wipers_between(s, default_glass().plane(), n / fps, (n + 1) / fps, corrected), film);
    double still = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) still += drops.u[i] == before.u[i] && drops.v[i] == before.v[i];
    // The widened sector, and behind its end drops that the last edge pushed: those stand beyond it, at most where
    // others stood, and move nothing.
    const double length = b.outer_radius - b.inner_radius, middle = 0.5 * (b.outer_radius + b.inner_radius), w = s.half_width;
    const double swept = (length + 2 * w) * middle * b.sweep + 2 * w * length + pi * w * w;
    const double p = 1 - swept / (1.4 * 0.8), n = static_cast<double>(drops.size());
    EXPECT_NEAR(still / n, p, 4 * std::sqrt(p * (1 - p) / n)) << fps;
  }
}

TEST(MotionWipe, NoDropsAndNoBladesAreFine) {
  Image film(Format::r32f, 4, 4);
  film.row<float>(2)[2] = 7;
  DropArrays none(0), some = random_drops(5, 1);
  const DropArrays before = some;
  EXPECT_EQ(wipe(none, {}, film), 0u);
  EXPECT_EQ(wipe(some, {}, film), 0u);
  EXPECT_TRUE(some == before);
  EXPECT_EQ(film.row<float>(2)[2], 7);
  EXPECT_EQ(wipe(none, wipers_between(inner_blade(), default_glass().plane(), 0, 0.5, corrected), film), 7u);
}

TEST(MotionWipe, ABladeAtRestTouchesNothing) {
  const WiperSettings s = inner_blade();
  const std::vector<Wiper> records = wipers_at(s, default_glass().plane(), 0.3);
  DropArrays drops = random_drops(5000, 9);
  const DropArrays before = drops;
  Image film = make_image(Format::r32f, 32, 32, [](int, int, int) { return 5.0f; });
  EXPECT_EQ(wipe(drops, records, film), 0u);
  EXPECT_TRUE(drops == before);
  EXPECT_EQ(film.row<float>(16)[16], 5);
  const parallel::Executor executor(1);
  wipe_drops(uniforms_of(records, false), false, records, drops.spans(), nullptr, executor);
  EXPECT_TRUE(drops == before);
}

}  // namespace
}  // namespace rainref::windshield
