// integrate corrected: exact motion, equivalence, hysteresis, evaporation.
#include <gtest/gtest.h>

#include "drops/physics.h"
#include "support.h"

namespace rainref::drops {
namespace {

using test::D;
using test::degree;

IntegrateUniforms uniforms(double dt, const Settings& s = {}) { return integrate_uniforms(s, test::frame, dt); }
// No hysteresis, no wind, no loss: constant force and linear drag alone.
IntegrateUniforms plain_drag(double dt, float drag) {
  IntegrateUniforms c = uniforms(dt);
  c.hold = c.wind_push = c.evaporation = 0;
  c.drag = drag;
  c.margin = 1000;
  return c;
}

// W4: x(t) = x0 + v_inf t + (v0 - v_inf)(1 - e^-dt) / d. A drop of one mass unit has the constants as they are.
TEST(IntegrateCorrected, IsTheExactSolution) {
  const GlassFrame glass{{0.25f, -5.5f}, {}, {}, 0, 0, {}, {}};
  for (const int fps : {24, 60, 144}) {
    for (const float drag : {30.0f, 100.0f, 1000.0f}) {  // drag dt above 1/8
      const IntegrateUniforms c = plain_drag(1.0 / fps, drag);
      auto d = test::state_of<D>(test::drop(0.25f, 0.75f, 1, 0, 0.5f, -0.25f));
      for (int n = 1; n <= 2 * fps; ++n) {
        d = scalar::integrate_corrected(c, glass, d);
        const double t = n * static_cast<double>(c.dt), e = std::exp(-drag * t);
        const double u_inf = 0.25 / drag, v_inf = -5.5 / drag;
        ASSERT_NEAR(d.velocity_u.v, u_inf + (0.5 - u_inf) * e, 1e-12);
        ASSERT_NEAR(d.velocity_v.v, v_inf + (-0.25 - v_inf) * e, 1e-12);
        ASSERT_NEAR(d.u.v, 0.25 + u_inf * t + (0.5 - u_inf) * (1 - e) / drag, 1e-12);
        ASSERT_NEAR(d.v.v, 0.75 + v_inf * t + (-0.25 - v_inf) * (1 - e) / drag, 1e-12);
      }
    }
  }
}

// Below drag dt = 1/8 a series of float coefficients takes over: right to 1e-8, a sixth of a rounding to float.
TEST(IntegrateCorrected, SeriesOfWeakDrag) {
  for (double x = 0; x < 0.13; x += 0.001) {
    const auto decay = scalar::decay_of(D(x));
    const double mean = x == 0 ? 1 : -std::expm1(-x) / x, way = x < 1e-4 ? 0.5 - x / 6 : (1 - mean) / x;
    EXPECT_NEAR(decay.speed.v, std::exp(-x), 1e-14);
    EXPECT_NEAR(decay.mean.v, mean, 1e-8);
    EXPECT_NEAR(decay.way.v, way, 1.2e-8);
  }
}

TEST(IntegrateCorrected, DoesNotDependOnTheFrameRate) {
  const GlassFrame glass{{0.25f, -5.5f}, {}, {}, 0, 0, {}, {}};
  double place[3];
  int k = 0;
  for (const int fps : {60, 120, 240}) {
    // Rates as powers of two times 1/256 s, so that every rate reaches the same second.
    const IntegrateUniforms c = plain_drag(fps == 60 ? 1.0 / 64 : fps == 120 ? 1.0 / 128 : 1.0 / 256, 40);
    auto d = test::state_of<D>(test::drop(0, 0, 1, 0, 0.5f, 0));
    for (int n = 0; n < static_cast<int>(1 / c.dt); ++n) d = scalar::integrate_corrected(c, glass, d);
    place[k++] = d.v.v;
  }
  EXPECT_NEAR(place[0], place[1], 1e-12);
  EXPECT_NEAR(place[1], place[2], 1e-12 + 4e-8 * std::abs(place[1]));  // 40 / 256 is near the series
}

std::vector<Drop> after(int steps, const GlassFrame& glass, float mass, float velocity_v = 0, const Settings& s = {}, double fps = 60) {
  const parallel::Executor executor(1);
  DropArrays a = test::arrays_of({test::drop(0.5f, 0.5f, mass, 0, 0, velocity_v, 1000)});
  for (int n = 0; n < steps; ++n) drops::integrate(executor, a, uniforms(1 / fps, s), glass, true);
  std::vector<Drop> out;
  a.gather(out, executor);
  return out;
}
float mass_of(double diameter) { return static_cast<float>(test::mass_units_of_diameter(diameter)); }

// W3: level braking at a is parking on a slope of atan(a / g) with g' = sqrt(g^2 + a^2): one specific force.
TEST(IntegrateCorrected, BrakingIsASlope) {
  const double beta = 27 * degree, a = 6, g = test::standard_gravity;
  // Up the glass is (-cos beta, sin beta) in (forward, up); the force is -g up, less a braking acceleration of -a forward.
  const double braking = -g * std::sin(beta) - a * std::cos(beta);
  const double sloped = -std::hypot(g, a) * std::sin(beta + std::atan2(a, g));
  for (const double mm : {2.0, 3.5, 5.0}) {
    const auto one = after(30, test::glass_of(0, braking), mass_of(mm * 1e-3)),
               other = after(30, test::glass_of(0, sloped), mass_of(mm * 1e-3));
    ASSERT_EQ(one.size(), 1u);
    // The two forces differ by the rounding of one double, so at most by one float.
    EXPECT_NEAR(one[0].position[1], other[0].position[1], 1e-6);
    EXPECT_NEAR(one[0].velocity[1], other[0].velocity[1], 1e-6);
  }
}

TEST(IntegrateCorrected, DropsBelowTheCriticalSizeRestAndAboveSlide) {
  for (const double beta : {27.0, 90.0}) {
    const double critical = critical_diameter(test::standard_gravity * std::sin(beta * degree), {50 * degree, 20 * degree});
    const auto resting = after(600, test::parked(beta * degree), mass_of(0.999 * critical));
    EXPECT_EQ(resting.at(0).position[1], 0.5f) << beta;
    EXPECT_EQ(resting.at(0).velocity[1], 0.0f) << beta;
    // Half a percent above: slowly, but down.
    const auto sliding = after(60, test::parked(beta * degree), mass_of(1.005 * critical));
    EXPECT_LT(sliding.at(0).position[1], 0.4999f) << beta;
  }
}

TEST(IntegrateCorrected, APushedSmallDropComesToRest) {
  const auto drops = after(600, test::parked(27 * degree), mass_of(2e-3), 0.3f);
  EXPECT_EQ(drops.at(0).velocity[1], 0.0f);
  EXPECT_GT(drops.at(0).position[1], 0.5f);
}

TEST(IntegrateCorrected, SettlesAtTheSpeedOfTheLinearLaw) {
  const double d = 4.5e-3, v = test::pi / 6 * d * d * d, pull = test::standard_gravity * std::sin(27 * degree);
  const double speed = (pull - held_acceleration(v, {50 * degree, 20 * degree})) / sliding_drag(v, 0.01);
  const auto drops = after(40, test::parked(27 * degree), mass_of(d));
  // In 2/3 s at a rate of 7.6 1/s it is there to e^-5.
  EXPECT_NEAR(-drops.at(0).velocity[1] * test::glass_height, speed, 0.01 * speed);
  EXPECT_GT(speed, 0.05);
  EXPECT_LT(speed, 0.5);
}

// Large drops run down, small ones stick; as the car speeds up, more and more sizes turn round and run up the glass.
TEST(IntegrateCorrected, WindTurnsDropsRoundAtTheBalanceWithHysteresis) {
  const Settings s;
  const double beta = 27 * degree, angle = 35 * degree;
  for (const double mm : {1.0, 2.0, 3.0, 5.0}) {
    const double d = mm * 1e-3, v = test::pi / 6 * d * d * d, pull = test::standard_gravity * std::sin(beta),
                 hold = held_acceleration(v, {50 * degree, 20 * degree});
    const double up = std::sqrt((pull + hold) / wind_acceleration(v, angle, s.wind_drag, s.wind_exposure));
    const auto at = [&](double wind) { return after(40, test::glass_of(0, -pull, 0, wind), mass_of(d)).at(0).position[1]; };
    EXPECT_GT(at(1.01 * up), 0.5f) << mm;
    EXPECT_EQ(at(0.99 * up), 0.5f) << mm;
    if (hold < pull) {
      const double down = std::sqrt((pull - hold) / wind_acceleration(v, angle, s.wind_drag, s.wind_exposure));
      EXPECT_LT(at(0.98 * down), 0.5f) << mm;
      EXPECT_EQ(at(1.02 * down), 0.5f) << mm;
    }
  }
}

// W3: what moves a drop of the wind is the apparent wind alone, so the frame of a car moving with it is that of a parked
// one in calm air. Here: no wind, no push, to the last bit.
TEST(IntegrateCorrected, NoApparentWindNoPush) {
  Settings still;
  still.wind_exposure = 0;
  const auto with = after(60, test::parked(27 * degree), mass_of(5e-3)),
             without = after(60, test::parked(27 * degree), mass_of(5e-3), 0, still);
  EXPECT_EQ(std::memcmp(with.data(), without.data(), sizeof(Drop)), 0);
}

TEST(IntegrateCorrected, EvaporatesAtTheRateOfHuAndLarson) {
  Settings s;
  s.humidity = 0.2;
  const double d = 2e-3, seconds = 20;
  const float mass = mass_of(d);
  // dm/dt = -k m^(1/3): m^(2/3) falls evenly.
  // The base of a cap of one mass unit, and the fit of H. Hu and R. G. Larson, J. Phys. Chem. B 106 (2002), which DropPhysics holds against
  // exact diffusion.
  const double angle = 35 * degree, c = std::cos(angle), sine = std::sin(angle);
  const double base = std::cbrt(3 * (2e-11 / 998.2) * sine * sine * sine / (test::pi * (2 + c) * (1 - c) * (1 - c)));
  const double k = test::pi * base * 2.4e-5 * (1 - 0.2) * 17.3e-3 * (0.27 * angle * angle + 1.30) / 2e-11;
  const double mass_units = mass - std::pow(std::pow(static_cast<double>(mass), 2.0 / 3) - 2 * k * seconds / 3, 1.5);
  for (const double fps : {30.0, 60.0, 240.0}) {
    const auto drops = after(static_cast<int>(seconds * fps), test::parked(0), mass, 0, s, fps);
    // The golden section spreads the phases so evenly that the roundings of n steps add up to less than log2(n) mass units.
    EXPECT_NEAR(mass - drops.at(0).mass, mass_units, std::log2(seconds * fps)) << fps;
  }
}

TEST(IntegrateCorrected, ADropThatDriesUpIsGoneAndSoIsItsWater) {
  const parallel::Executor executor(1);
  Settings s;
  s.humidity = 0;
  DropArrays a = test::arrays_of({test::drop(0.5f, 0.5f, 50, 0, 0, 0, 1000)});
  MassBalance sum;
  int steps = 0;
  for (; a.live() > 0 && steps < 6000; ++steps) sum += drops::integrate(executor, a, uniforms(1.0 / 60, s), test::parked(0), true);
  EXPECT_LT(steps, 6000);
  EXPECT_EQ(sum.evaporated, 50);
  EXPECT_EQ(sum.removed, 0);
  EXPECT_EQ(a.water(), 0);
}

TEST(IntegrateCorrected, LifeAndTheEdgeRemove) {
  const parallel::Executor executor(1);
  DropArrays a = test::arrays_of({test::drop(0.5f, 0.5f, 1000, 0, 0, 0, 0.05f), test::drop(0.5f, 0.001f, mass_of(6e-3), 1, 0, -3),
                                  test::drop(1.0199f, 0.5f, 3000, 2)});
  const std::int64_t before = a.water();
  Settings s;
  s.humidity = 1;
  MassBalance sum;
  for (int n = 0; n < 3; ++n) sum += drops::integrate(executor, a, uniforms(1.0 / 60, s), test::parked(27 * degree), true);
  EXPECT_EQ(a.live(), 1);  // the last one lies within the margin of 0.02
  EXPECT_EQ(sum.evaporated, 0);
  EXPECT_EQ(sum.removed, before - 3000);
}

// Euler and Coriolis forces enter as the frame gives them: a = gravity + spin x + coriolis v.
TEST(IntegrateCorrected, TakesTheCarsRotationFromTheFrame) {
  GlassFrame g{};
  for (int k = 0; k < 4; ++k) {  // no two alike
    g.spin[k] = 0.5f * static_cast<float>(k + 1);
    g.coriolis[k] = 3 - 1.25f * static_cast<float>(k);
  }
  const IntegrateUniforms c = plain_drag(1.0 / 60, 60);
  auto d = test::state_of<D>(test::drop(0.25f, 0.75f, 1, 0, 0.125f, -0.5f));
  d = scalar::integrate_corrected(c, g, d);
  const double dt = c.dt, e = std::exp(-60 * dt), f = (1 - e) / 60;
  const double a_u = 0.5 * 0.25 + 1 * 0.75 + 3 * 0.125 + 1.75 * -0.5, a_v = 1.5 * 0.25 + 2 * 0.75 + 0.5 * 0.125 - 0.75 * -0.5;
  EXPECT_NEAR(d.velocity_u.v, 0.125 * e + a_u * f, 1e-12);
  EXPECT_NEAR(d.velocity_v.v, -0.5 * e + a_v * f, 1e-12);
}

}  // namespace
}  // namespace rainref::drops
