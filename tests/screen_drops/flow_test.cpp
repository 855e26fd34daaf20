// Drops on an upright pane: how fast they slide, what trails do with the water, what arrives. What sticks, and merging: tests/drops.
#include <gtest/gtest.h>

#include <algorithm>

#include "math/half.h"
#include "screen_drops/flow_support.h"

namespace rainref::screen_drops {
namespace {

using namespace test;

const parallel::Executor& two_threads() {
  static const parallel::Executor executor(2);
  return executor;
}
// W4, of a drop that gravity pulls, hysteresis holds and viscosity slows: v = v_inf (1 - e^-kt) and
// x = v_inf t - v_inf (1 - e^-kt) / k, at every frame rate and number of steps.
TEST(Flow, ASlidingDropHasTheExactSpeedAndPlace) {
  for (const double mm : {3.0, 3.5, 5.0}) {
    for (const double fps : {30.0, 60.0, 144.0}) {
      for (const int substeps : {1, 3}) {
        FlowSettings s = dry_pane();
        s.fps = fps;
        s.substeps = substeps;
        const float mass = mass_of(mm * 1e-3);
        const double volume = volume_of(mass), k = drops::sliding_drag(volume, s.drops.mobility);
        const double final_speed = (test::gravity - drops::held_acceleration(volume, {50 * degree, 20 * degree})) / k;
        const int frames = static_cast<int>(fps / 5);
        const double t = frames / fps, speed = final_speed * -std::expm1(-k * t), way = final_speed * (t + std::expm1(-k * t) / k);
        const Drop d = after(s, mass, frames, two_threads());
        // The pull beyond the hold is half of it or less, which doubles some ten roundings of 2^-24, or trebles them at
        // 3 mm; a step adds three to what e^-kt leaves of those before: 1e-5 in all. Each step rounds the place to 2^-25.
        EXPECT_LT(d.velocity[1], 0);
        EXPECT_NEAR(-d.velocity[1] * s.pane[1], speed, 1e-5 * speed) << mm << ' ' << fps << ' ' << substeps;
        EXPECT_NEAR((0.75 - d.position[1]) * s.pane[1], way, 1e-5 * way + frames * substeps * 0x1p-25 * s.pane[1])
            << mm << ' ' << fps << ' ' << substeps;
        EXPECT_EQ(d.position[0], 0.5f);
        EXPECT_EQ(d.velocity[0], 0.0f);
        EXPECT_EQ(d.mass, mass);
      }
    }
  }
}

// A raindrop alone sticks; two that touch are heavy enough to run.
TEST(Flow, TwoStuckDropsRunAsOne) {
  const float mass = mass_of(2.3e-3);
  const auto radius = static_cast<float>(drops::cap_radius_over_root(35 * degree) * std::cbrt(volume_of(mass)) / dry_pane().pane[0]);
  for (const float distance : {1.9f, 2.1f}) {  // in radii
    Flow flow(dry_pane(), two_threads());
    const std::vector<Drop> two{drop_at(0.5f, 0.75f, mass, 0), drop_at(0.5f + distance * radius, 0.75f, mass, 1)};
    flow.set_drops(two);
    for (int n = 0; n < 30; ++n) flow.simulate();
    const std::vector<Drop> left = flow.drops();
    EXPECT_EQ(left.size(), distance < 2 ? 1u : 2u);
    EXPECT_EQ(left[0].id, 0u);
    EXPECT_EQ(left[0].mass, distance < 2 ? 2 * mass : mass);
    EXPECT_EQ(left[0].position[1] < 0.75f, distance < 2);
    EXPECT_EQ(flow.residual(), 0);
  }
}

// What a sliding drop loses lies in its wake, in one column of texels between its tail's first and last place.
TEST(Flow, TrailsStayInTheFilm) {
  FlowSettings s = dry_pane();
  s.drops.trail_thickness = 5e-6;
  s.drops.mobility = 1e-3;  // slowly, so that no row is left out
  Flow flow(s, two_threads());
  const float mass = mass_of(3.5e-3);
  const std::vector<Drop> one{drop_at(0.5f, 0.75f, mass)};
  flow.set_drops(one);
  for (int n = 0; n < 120; ++n) flow.simulate();
  const Drop d = flow.drops().at(0);
  const std::int64_t lost = static_cast<std::int64_t>(mass - d.mass);
  EXPECT_GT(lost, 10000);
  EXPECT_EQ(flow.mass_balance().to_film, lost);
  EXPECT_EQ(drops::film_water(flow.film()), lost);
  EXPECT_EQ(flow.residual(), 0);
  const double radius = drops::cap_radius_over_root(35 * degree) * std::cbrt(volume_of(d.mass)) / s.pane[1];
  const int column = flow.film().width() / 2, first = static_cast<int>((d.position[1] + radius) * flow.film().height()),
            last = static_cast<int>((0.75 + radius) * flow.film().height());
  EXPECT_GT(last, first + 10);
  for (int y = 0; y < flow.film().height(); ++y) {
    for (int x = 0; x < flow.film().width(); ++x) {
      if (x == column && (y == first || y == last)) continue;
      EXPECT_EQ(flow.film().row<float>(y)[x] > 0, x == column && y > first && y < last) << x << ' ' << y;
    }
  }
}

// The height texture holds the water of drop and film, where they are: W6, a radius of seven texels.
TEST(Flow, TheHeightTextureHoldsTheWater) {
  FlowSettings s = dry_pane();
  s.splat.width = 640;
  s.splat.height = 480;
  s.pane = {0.32, 0.24};
  s.drops.trail_thickness = 5e-6;
  Flow flow(s, two_threads());
  const std::vector<Drop> one{drop_at(0.3f, 0.75f, mass_of(3.5e-3))};
  flow.set_drops(one);
  for (int n = 0; n < 20; ++n) flow.simulate();
  const Drop d = flow.drops().at(0);
  ASSERT_LT(d.position[1], 0.74f);
  double sum = 0, x_sum = 0, top = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double h = to_float(flow.height().row<Half>(y)[x]);
      sum += h;
      x_sum += h * (x + 0.5);
      top = std::max(top, h);
    }
  }
  const double texel = 0.32 / 640 * 0.24 / 480, volume = volume_of(d.mass) + volume_of(static_cast<double>(drops::film_water(flow.film())));
  EXPECT_NEAR(sum * 1e-3 * texel, volume, 0.01 * volume);
  EXPECT_NEAR(x_sum / sum, 0.3 * 640, 0.2);
  // A paraboloid over the base of the mean contact angle: V = pi a^2 h / 2. The nearest centre of a texel is up to 0.7 of the
  // radius' seven texels off, 1 % of h, and the film under the drop adds a little.
  const double base = drops::cap_radius_over_root(35 * degree) * std::cbrt(volume_of(d.mass)),
               h = 2 * volume_of(d.mass) / (pi * base * base) * 1e3;
  EXPECT_NEAR(top, h, 0.03 * h);
}

/// Drops that arrived, by the ids that spawn gives out.
struct Arrivals : Recorder {
  std::int64_t count = 0;
  void before(const PassStart& start) override {
    if (start.pass != "spawn") return;
    drops::SpawnUniforms u;
    std::memcpy(&u, start.uniforms.data(), sizeof u);
    count = u.first_id;
  }
  void pass(const PassCall&) override {}
};

// Marshall and Palmer's drops, 8000 e^-(Lambda D) to a cubic metre and a millimetre, carried by the wind alone.
TEST(Flow, WindBringsTheRainOfItsPath) {
  FlowSettings s = dry_pane();
  s.drops.capacity = 100000;
  for (const double wind : {0.0, 2.0, 7.5}) {
    s.wind = wind;
    Flow flow(s, two_threads());
    Arrivals arrivals;
    const int frames = 1200;
    for (int n = 0; n <= frames; ++n) flow.simulate(n == frames ? &arrivals : nullptr);
    const double lambda = 4.1 * std::pow(s.drops.rain_rate, -0.21), path = wind * s.pane[0] * s.pane[1] * frames / s.fps;
    const double mean = path * 8000 / lambda * (std::exp(-lambda * s.drops.smallest_drop) - std::exp(-lambda * 6));
    // A Poisson number: 4 of its deviations. The seed is fixed.
    EXPECT_NEAR(static_cast<double>(arrivals.count), mean, 4 * std::sqrt(mean)) << wind;
    EXPECT_EQ(flow.residual(), 0);
  }
}

/// What every texel of the film lost.
struct Drying : Recorder {
  double mass_units = 0;
  void before(const PassStart& start) override {
    if (start.pass != "merge") return;
    drops::MergeUniforms u;
    std::memcpy(&u, start.uniforms.data(), sizeof u);
    mass_units += static_cast<double>(u.drying);
  }
  void pass(const PassCall&) override {}
};
TEST(Flow, TheFilmDriesAtItsRateWhateverTheFrameRate) {
  FlowSettings s = dry_pane();
  s.drops.film_drying = 3e-8;
  const double texel = s.pane[0] / s.splat.width * s.pane[1] / s.splat.height;
  for (const double fps : {24.0, 144.0}) {
    s.fps = fps;
    for (s.substeps = 1; s.substeps <= 3; ++s.substeps) {
      Flow flow(s, two_threads());
      Drying drying;
      for (int n = 0; n < 5 * fps; ++n) flow.simulate(&drying);
      EXPECT_NEAR(drying.mass_units, 5 * s.drops.film_drying * texel * drops::water_density / drops::mass_unit, 1) << fps;
    }
  }
}

// Rain while nobody looks is the rain that the next frames would have brought.
TEST(Flow, WarmingUpIsRunningOn) {
  FlowSettings s = wet_pane();
  s.substeps = 2;
  Flow from_dry(s, two_threads());
  for (int n = 0; n < 70; ++n) from_dry.simulate();
  s.warm_up = 50 / s.fps;
  Flow warm(s, two_threads());
  EXPECT_EQ(warm.frame(), 0);
  for (int n = 0; n < 20; ++n) warm.simulate();
  EXPECT_EQ(warm.frame(), 20);
  EXPECT_EQ(bytes_of(warm.drops()), bytes_of(from_dry.drops()));
  EXPECT_EQ(bytes_of(warm.height()), bytes_of(from_dry.height()));
  EXPECT_EQ(warm.mass_balance(), from_dry.mass_balance());
}

// W8: every mass unit that arrived is in a drop, in the film, in the air, or gone.
TEST(Flow, TheMassBalanceIsZeroToTheUnit) {
  for (const int substeps : {1, 2}) {
    FlowSettings s = wet_pane();
    s.substeps = substeps;
    Flow flow(s, two_threads());
    std::int64_t film_peak = 0;
    for (int n = 0; n < 2400; ++n) {
      flow.simulate();
      ASSERT_EQ(flow.residual(), 0) << n;
      film_peak = std::max(film_peak, drops::film_water(flow.film()));
      ASSERT_EQ(flow.mass_balance().to_film, drops::film_water(flow.film())) << n;
    }
    // Every way that water takes was taken. With room for more and lives that last, drops end where they run off below.
    EXPECT_GT(flow.mass_balance().evaporated, 0);
    EXPECT_GT(flow.mass_balance().removed, mass_of(3e-3));
    EXPECT_LT(static_cast<std::int64_t>(flow.drops().size()), s.drops.capacity / 2);
    EXPECT_GT(film_peak, 0);
    EXPECT_FALSE(flow.drops().empty());
  }
}

// More arrive than there is room for: their water is accounted for as removed.
TEST(Flow, AFullPaneLosesArrivalsNotTheCount) {
  FlowSettings s = wet_pane();
  s.drops.capacity = 20;
  Flow flow(s, two_threads());
  for (int n = 0; n < 120; ++n) {
    flow.simulate();
    ASSERT_EQ(flow.residual(), 0);
    ASSERT_LE(flow.drops().size(), 20u);
  }
  EXPECT_GT(flow.mass_balance().removed, 0);
  flow.set_drops({});
  EXPECT_EQ(flow.residual(), 0);
  EXPECT_TRUE(flow.drops().empty());
}

}  // namespace
}  // namespace rainref::screen_drops
