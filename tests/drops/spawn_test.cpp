// W9: how many drops arrive, where, how heavy, and what happens when there is no room.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "base/error_of.h"
#include "rain/rain.h"
#include "rainref/error.h"
#include "random/statistics.h"
#include "support.h"

namespace rainref::drops {
namespace {

using test::degree;

constexpr double beta = 30 * degree;
Exposure exposure(double speed_kmh, double area = 1.12) { return {area, std::cos(beta), -speed_kmh / 3.6 * std::sin(beta)}; }
Settings rain(double rate, double smallest = 0.5) {
  Settings s;
  s.seed = 42;
  s.rain_rate = rate;
  s.smallest_drop = smallest;
  return s;
}
std::vector<Drop> arrivals(const SpawnPlan& plan, bool all = true) { return arrivals_of(plan.uniforms, plan.thresholds, plan.masses, all); }

// Flux at 10 mm/h on glass at 30 degrees, all sizes: F cos(beta) + N_T U sin(beta). [1/m^2/s], rounded to two digits.
TEST(Spawn, FluxGrowsWithSpeedAsTheTablesSay) {
  const double table[][3] = {{0, 4.2e3, 10.1}, {50, 2.6e4, 25.5}, {100, 4.8e4, 40.9}, {130, 6.1e4, 50.1}};
  for (const auto& [speed, drops, water_mm_h] : table) {
    // The tables begin at 0 mm and end at 8 mm; drops from 0 to 0.1 mm are 22 % of N_T, those above 6 mm carry 1 % of the water.
    const Flux f = flux(rain(10, 1e-6), std::cos(beta), -speed / 3.6 * std::sin(beta));
    EXPECT_NEAR(f.drops, drops, 0.02 * drops) << speed;
    EXPECT_NEAR(f.water / 998.2 * 1e3 * 3600, water_mm_h, 0.015 * water_mm_h) << speed;
  }
}

TEST(Spawn, FluxIsVerticalFluxPlusDensityTimesSpeed) {
  for (const double rate : {1.0, 25.0}) {
    const double lambda = rain::DropSizes(rate, 0.5).lambda();
    const double vertical = rain::DropSizes(rate, 0.5).flux(), in_air = 8000 / lambda * (std::exp(-lambda * 0.5) - std::exp(-lambda * 6));
    for (const double speed : {0.0, 90.0}) {
      const double expected = vertical * std::cos(beta) + in_air * speed / 3.6 * std::sin(beta);
      EXPECT_NEAR(flux(rain(rate), std::cos(beta), -speed / 3.6 * std::sin(beta)).drops, expected, 2e-5 * expected);
    }
  }
}

TEST(Spawn, NoRainFromBehindOrWithoutRain) {
  EXPECT_EQ(flux(rain(10), 0, 1).drops, 0);
  EXPECT_EQ(flux(rain(0), 1, -10).drops, 0);
  Arrivals a(rain(0));
  EXPECT_TRUE(arrivals(a.plan(exposure(100), 0, 60, 0, 10)).empty());
  // Drops that fall faster than the wind blows them away still arrive.
  EXPECT_GT(flux(rain(10), 1, 5).drops, 0);
  EXPECT_LT(flux(rain(10), 1, 5).drops, flux(rain(10), 1, 0).drops);
}

// Galilean: only the apparent wind enters, so wind + c and vehicle + c give the same plan.
TEST(Spawn, DependsOnTheApparentWindAlone) {
  Arrivals a(rain(10)), b(rain(10));
  const double normal_x = std::sin(beta);
  const auto normal_wind = [&](double wind, double vehicle) { return (wind - vehicle) * normal_x; };
  const auto moving = arrivals(a.plan({1, std::cos(beta), normal_wind(8, 8)}, 3, 60, 0, 1000));
  const auto parked = arrivals(b.plan({1, std::cos(beta), normal_wind(0, 0)}, 3, 60, 0, 1000));
  ASSERT_EQ(moving.size(), parked.size());
  EXPECT_EQ(std::memcmp(moving.data(), parked.data(), moving.size() * sizeof(Drop)), 0);
}

TEST(Spawn, CountsArePoisson) {
  // mean about 50, and about 9000 in three draws.
  for (const double area : {0.4, 72.0}) {
    Arrivals a(rain(5));
    constexpr int steps = 2000;
    double sum = 0, squares = 0;
    for (int n = 0; n < steps; ++n) {
      const auto count = static_cast<double>(arrivals(a.plan(exposure(50, area), n, 60, 0, 0)).size());
      sum += count;
      squares += count * count;
    }
    const double expected = a.plan(exposure(50, area), 0, 60, 0, 0).mean, mean = sum / steps, variance = squares / steps - mean * mean;
    EXPECT_NEAR(mean, expected, 4 * std::sqrt(expected / steps));
    EXPECT_NEAR(variance / mean, 1, 3 * std::sqrt(2.0 / steps));
    EXPECT_NEAR(expected, flux(rain(5), std::cos(beta), -50 / 3.6 * std::sin(beta)).drops * area / 60, 1e-9 * expected);
  }
}

TEST(Spawn, PlacesAreUniformAndIdsAscend) {
  Arrivals a(rain(20));
  std::vector<int> cells(100, 0);
  std::uint32_t next = 7;
  for (int n = 0; n < 100; ++n) {
    for (const Drop& d : arrivals(a.plan(exposure(50), n, 60, next, 1 << 20))) {
      ASSERT_EQ(d.id, next++);
      ASSERT_TRUE(d.position[0] >= 0 && d.position[0] < 1 && d.position[1] >= 0 && d.position[1] < 1);
      ASSERT_EQ(d.velocity[0], 0);
      ASSERT_EQ(d.life, 600);
      ++cells[rainref::test::cell_of(d.position[0], d.position[1])];
    }
  }
  const double chi = rainref::test::chi_square(cells);
  EXPECT_GT(chi, rainref::test::chi_square_99_low);
  EXPECT_LT(chi, rainref::test::chi_square_99_high);
}

// x, y and mass are drawn from words of their own: no two of them know of each other. Both variants.
TEST(Spawn, PlacesAndMassesAreIndependent) {
  for (const bool corrected : {true, false}) {
    Settings s = rain(20);
    s.corrected = corrected;
    s.spawn_rate = 30000;
    Arrivals a(s);
    std::vector<int> x_mass(100, 0), y_mass(100, 0);
    for (int n = 0; n < 60; ++n) {
      const SpawnPlan& plan = a.plan(exposure(50), n, 60, 0, 1 << 20);
      std::vector<float> masses;  // equally many drops in each, lightest first
      for (const SpawnMass& m : plan.masses) masses.push_back(m.mass);
      for (const Drop& d : arrivals(plan)) {
        const auto [first, last] = std::equal_range(masses.begin(), masses.end(), d.mass);
        const double rank = 0.5 * static_cast<double>((first - masses.begin()) + (last - masses.begin())) / 1024;
        ++x_mass[rainref::test::cell_of(d.position[0], rank)];
        ++y_mass[rainref::test::cell_of(d.position[1], rank)];
      }
    }
    for (const std::vector<int>* cells : {&x_mass, &y_mass}) {
      const double chi = rainref::test::chi_square(*cells);
      EXPECT_GT(chi, rainref::test::chi_square_99_low) << corrected;
      EXPECT_LT(chi, rainref::test::chi_square_99_high) << corrected;
    }
  }
}

// Boolean model: discs of radius R with n on area A cover 1 - exp(-n pi R^2 / A). Measured on a grid inside the glass.
TEST(Spawn, CoverageOfFixedDiscs) {
  Arrivals a(rain(10));
  std::vector<Drop> drops;
  for (int n = 0; n < 60; ++n) {
    for (const Drop& d : arrivals(a.plan({1, 1, 0}, n, 60, 0, 0))) drops.push_back(d);
  }
  constexpr double radius = 0.006;
  constexpr int side = 300;
  std::vector<char> covered(side * side, 0);
  for (const Drop& d : drops) {
    for (int y = 0; y < side; ++y) {
      const double dy = (y + 0.5) / side - d.position[1];
      if (std::abs(dy) > radius) continue;
      for (int x = 0; x < side; ++x) {
        const double dx = (x + 0.5) / side - d.position[0];
        if (dx * dx + dy * dy < radius * radius) covered[static_cast<std::size_t>(y * side + x)] = 1;
      }
    }
  }
  const int from = 6, to = side - 6;  // away from the edge, beyond which no drop falls
  double share = 0;
  for (int y = from; y < to; ++y) {
    for (int x = from; x < to; ++x) share += covered[static_cast<std::size_t>(y * side + x)];
  }
  share /= (to - from) * (to - from);
  EXPECT_NEAR(share, 1 - std::exp(-static_cast<double>(drops.size()) * test::pi * radius * radius), 0.01);
}

TEST(Spawn, MassesFollowTheDistribution) {
  const Settings s = rain(10);
  Arrivals a(s);
  const SpawnPlan& plan = a.plan(exposure(100), 0, 60, 0, 0);
  ASSERT_EQ(plan.masses.size(), 1024u);
  double mean = 0;
  for (std::size_t k = 0; k < plan.masses.size(); ++k) {
    const float m = plan.masses[k].mass;
    ASSERT_EQ(m, std::floor(m));
    if (k > 0) {
      ASSERT_GE(m, plan.masses[k - 1].mass);
    }
    mean += m / 1024.0;
  }
  EXPECT_GE(plan.masses.front().mass, test::mass_units_of_diameter(0.5e-3));
  // The classes are medians of their parts; the tail's is below its mean.
  const Flux f = flux(s, std::cos(beta), -100 / 3.6 * std::sin(beta));
  EXPECT_NEAR(mean, f.water / f.drops / mass_unit, 0.02 * mean);
}

TEST(Spawn, AsPublishedCountsAreExactAndMassesEven) {
  Settings s;
  s.corrected = false;
  s.spawn_rate = 400;
  s.lifetime = 6;
  Arrivals a(s);
  int sum = 0;
  for (int n = 0; n < 60; ++n) {
    const auto count = static_cast<int>(arrivals(a.plan(exposure(0), n, 60, 0, 0)).size());
    EXPECT_TRUE(count == 6 || count == 7) << n;
    sum += count;
    EXPECT_EQ(sum, 400 * (n + 1) / 60) << n;
  }
  EXPECT_EQ(sum, 400);
  double mean = 0;
  for (const SpawnMass& m : a.plan(exposure(0), 0, 60, 0, 0).masses) mean += m.mass / 1024.0;
  EXPECT_NEAR(mean, 1, 1e-6);
}

TEST(Spawn, ThreadsShareTheArrivals) {
  Arrivals a(rain(50));
  const SpawnPlan& plan = a.plan(exposure(100), 3, 2, 17, 1 << 20);
  const std::vector<Drop> alone = arrivals(plan);
  ASSERT_GT(alone.size(), 4000u);
  for (const int threads : {1, 2, 3, 8}) {
    const parallel::Executor executor(threads);
    const std::vector<Drop> shared = arrivals_of(plan.uniforms, plan.thresholds, plan.masses, true, &executor);
    ASSERT_EQ(shared.size(), alone.size());
    EXPECT_EQ(std::memcmp(shared.data(), alone.data(), alone.size() * sizeof(Drop)), 0) << threads << " threads";
  }
}

TEST(Spawn, RoomIsFilledAndTheRestIsLost) {
  Settings s = rain(50);
  Arrivals a(s);
  DropArrays drops(100);
  const parallel::Executor executor(2);
  MassBalance sum;
  for (int n = 0; n < 5; ++n) {
    const SpawnPlan& plan = a.plan(exposure(100), n, 60, drops.next_id(), drops.free_slots());
    const auto inside = arrivals(plan, false);
    EXPECT_EQ(inside.size(), std::min<std::size_t>(arrivals(plan).size(), static_cast<std::size_t>(drops.free_slots())));
    sum += spawn(executor, drops, plan.uniforms, plan.thresholds, plan.masses, true);
  }
  EXPECT_EQ(drops.live(), 100);
  EXPECT_EQ(drops.free_slots(), 0);
  EXPECT_GT(sum.removed, 0);
  EXPECT_EQ(sum.spawned - sum.removed, drops.water());
  EXPECT_GT(drops.next_id(), 1000u);  // ids of those that found no room are used up
}

TEST(Spawn, RefusesTablesThatDoNotBelong) {
  Arrivals a(rain(10));
  SpawnPlan plan = a.plan(exposure(0), 0, 60, 0, 10);
  const auto refuses = [&] { return error_of([&] { arrivals(plan); }).starts_with("3 "); };
  EXPECT_FALSE(refuses());
  plan.uniforms.threshold_count = static_cast<std::int32_t>(plan.thresholds.size()) + 1;
  EXPECT_TRUE(refuses());
  plan.uniforms.threshold_count = -1;
  EXPECT_TRUE(refuses());
  plan = a.plan(exposure(0), 0, 60, 0, 10);
  plan.uniforms.parts = 0xffffffffu;
  EXPECT_TRUE(refuses());
  plan = a.plan(exposure(0), 0, 60, 0, 10);
  plan.masses.pop_back();
  EXPECT_TRUE(refuses());
}

}  // namespace
}  // namespace rainref::drops
