// integrate as published, against the exact solutions of its own recurrence and of the equation that it steps.
#include <gtest/gtest.h>

#include "support.h"

namespace rainref::drops {
namespace {

using test::D;

IntegrateUniforms uniforms(double dt, double drag = 3, double wind_coupling = 0.25, double inertia_coupling = 0.5) {
  Settings s;
  s.corrected = false;
  s.drag = drag;
  s.wind_coupling = wind_coupling;
  s.inertia_coupling = inertia_coupling;
  return integrate_uniforms(s, {}, dt);
}
constexpr GlassFrame glass{{0.25f, -5.5f}, {0.5f, 7}, {1, -2}, 0, 0, {}, {}};

// W4: with q = 1 - d h and v_inf = A / d, semi-implicit Euler gives v_n = v_inf + (v_0 - v_inf) q^n and
// x_n = x_0 + v_inf n h + (v_0 - v_inf) q (1 - q^n) / d.
TEST(IntegrateAsPublished, IsItsRecurrenceExactly) {
  for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    const IntegrateUniforms c = uniforms(h);
    auto d = test::state_of<D>(test::drop(0.25f, 0.75f, 1.5f, 0, 0.5f, -0.25f));
    const double dt = c.dt, drag = c.drag, q = 1 - drag * dt;
    const auto v_inf = [&](int axis) {
      return (static_cast<double>(glass.gravity[axis]) * 1.5 - static_cast<double>(glass.acceleration[axis]) * c.inertia_coupling +
              static_cast<double>(glass.wind[axis]) * c.wind_coupling) /
             drag;
    };
    const double u_inf = v_inf(0), w_inf = v_inf(1);
    for (int n = 1; n <= 200; ++n) {
      d = scalar::integrate_as_published(c, glass, d);
      const double qn = std::pow(q, n);
      // 200 steps of doubles: a few hundred roundings of 1e-16.
      ASSERT_NEAR(d.velocity_u.v, u_inf + (0.5 - u_inf) * qn, 1e-12);
      ASSERT_NEAR(d.velocity_v.v, w_inf + (-0.25 - w_inf) * qn, 1e-12);
      ASSERT_NEAR(d.u.v, 0.25 + u_inf * n * dt + (0.5 - u_inf) * q * (1 - qn) / drag, 1e-12);
      ASSERT_NEAR(d.v.v, 0.75 + w_inf * n * dt + (-0.25 - w_inf) * q * (1 - qn) / drag, 1e-12);
      ASSERT_NEAR(d.life.v, 100 - n * dt, 1e-10);
    }
  }
}

TEST(IntegrateAsPublished, SettlesAtTheBalanceOfForces) {
  const parallel::Executor executor(1);
  DropArrays a = test::arrays_of({test::drop(0, 0, 0.5f, 0, 1, 1, 1000), test::drop(0, 0, 2, 1, -1, 0, 1000)});
  const IntegrateUniforms c = uniforms(1.0 / 60);
  for (int n = 0; n < 1200; ++n) drops::integrate(executor, a, c, glass, false);
  for (std::size_t i = 0; i < 2; ++i) {
    const double m = i == 0 ? 0.5 : 2;
    // Floats stop where a dt no longer changes the velocity: half a rounding of it, 2^-24, over drag dt = 1/20, and as
    // much again for the rounding of the force.
    const auto off = [](double v) { return 2 * 20 * 0x1p-24 * std::max(1.0, std::abs(v)); };
    const double u = (0.25 * m - 1 * 0.5 + 0.5 * 0.25) / 3, v = (-5.5 * m + 2 * 0.5 + 7 * 0.25) / 3;
    EXPECT_NEAR(a.velocity_u()[i], u, off(u));
    EXPECT_NEAR(a.velocity_v()[i], v, off(v));
  }
}

double place_after_a_second(int fps) {
  const IntegrateUniforms c = uniforms(1.0 / fps);
  auto d = test::state_of<D>(test::drop(0, 0, 1, 0));
  for (int n = 0; n < fps; ++n) d = scalar::integrate_as_published(c, glass, d);
  return d.v.v;
}
TEST(IntegrateAsPublished, ErrorOfTheStepIsOfFirstOrder) {
  const double ratio = (place_after_a_second(60) - place_after_a_second(120)) / (place_after_a_second(120) - place_after_a_second(240));
  EXPECT_NEAR(ratio, 2, 0.1);
}

// W5: the wind of a car at U* = m g sin(beta) / (k_w cos(beta)) holds a drop; a little more blows it up the glass.
TEST(IntegrateAsPublished, TurnsRoundAtTheThresholdSpeed) {
  const parallel::Executor executor(1);
  const double beta = 27 * test::degree, coupling = 0.33;
  for (const double m : {0.5, 1.0, 1.6}) {
    const double threshold = m * test::standard_gravity * std::sin(beta) / (coupling * std::cos(beta));
    for (const double share : {0.999, 1.001}) {
      DropArrays a = test::arrays_of({test::drop(0.5f, 0.5f, static_cast<float>(m), 0)});
      const IntegrateUniforms c = uniforms(1.0 / 60, 12, coupling);
      const GlassFrame moving = test::glass_of(0, -test::standard_gravity * std::sin(beta), 0, share * threshold * std::cos(beta));
      for (int n = 0; n < 120; ++n) drops::integrate(executor, a, c, moving, false);
      EXPECT_EQ(a.velocity_v()[0] > 0, share > 1) << m << " " << share;
    }
  }
}

TEST(IntegrateAsPublished, LivesEndAndDeadDropsStayAsTheyAre) {
  const parallel::Executor executor(1);
  DropArrays a = test::arrays_of({test::drop(0.5f, 0.5f, 1, 0, 0, 0, 0.1f), test::drop(0.5f, 0.5f, 1, 1, 1, 1, -0.25f)});
  std::int64_t ended = 0;
  for (int n = 0; n < 10; ++n) ended += drops::integrate(executor, a, uniforms(1.0 / 60), glass, false).removed;
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(a.live(), 0);
  EXPECT_EQ(a.get(1).life, -0.25f);
  EXPECT_EQ(a.get(1).position[0], 0.5f);
  // The life of the first ended in step 6 or 7 (0.1 s); then it stood still too.
  EXPECT_LE(a.get(0).life, 0);
  EXPECT_GT(a.get(0).life, -1.1f / 60);
}

}  // namespace
}  // namespace rainref::drops
