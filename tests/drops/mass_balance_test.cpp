// The water balance over a long run is exactly zero.
#include <gtest/gtest.h>

#include "support.h"

namespace rainref::drops {
namespace {

TEST(DropsMassBalance, IsExactlyZeroOverALongRun) {
  Settings s;
  s.seed = 6;
  s.rain_rate = 40;
  s.humidity = 0.4;
  s.lifetime = 15;
  s.film_drying = 2e-6;
  const parallel::Executor executor(2);
  DropArrays a(4000);
  Arrivals arrivals(s);
  Merger merger;
  Image film(Format::r32f, 64, 32);
  MassBalance sum;
  std::int64_t merged = 0, most_live = 0, film_peak = 0;
  constexpr double fps = 60;
  for (int n = 0; n < 2400; ++n) {
    // The car speeds up, drives fast and brakes again.
    const double speed = 30 * std::sin(test::pi * n / 2400), wind = speed * 0.89;
    const SpawnPlan& plan = arrivals.plan({1.12, 0.89, -speed * 0.45}, n, fps, a.next_id(), a.free_slots());
    sum += spawn(executor, a, plan.uniforms, plan.thresholds, plan.masses, true);
    sum += drops::integrate(executor, a, integrate_uniforms(s, test::frame, 1 / fps), test::glass_of(0.5, -4.45, 0, wind), true);
    const MergeUniforms merge = merge_uniforms(s, test::frame, 1 / fps, 64, 32, film_loss(s, 1.12 / (64 * 32), n, fps));
    const std::int64_t before = a.live();
    sum += merger.run(executor, a, merge, film);
    merged += before - a.live();
    ASSERT_EQ(sum.to_film, film_water(film)) << n;
    ASSERT_EQ(sum.spawned - sum.evaporated - sum.removed - sum.to_film, a.water()) << n;
    most_live = std::max(most_live, a.live());
    film_peak = std::max(film_peak, sum.to_film);
  }
  // Every way that water takes was taken.
  EXPECT_GT(merged, 10000);
  EXPECT_GT(sum.evaporated, 0);
  EXPECT_GT(sum.removed, 0);
  EXPECT_GT(film_peak, 0);
  EXPECT_GT(most_live, 500);
}

}  // namespace
}  // namespace rainref::drops
