// Pass wipe_drops as published: what is captured, and the bow wave (physics: W12).
#include <gtest/gtest.h>

#include "windshield/sweep_geometry.h"

namespace rainref::windshield {
namespace {

// A blade of constant rate. The drop's lag behind its target settles at v dt (1 - follow) / follow.
TEST(MotionPublished, DropsLagBehindTheBlade) {
  const Glass glass = default_glass();
  const parallel::Executor executor(1);
  for (const double follow : {0.5, 0.6, 0.9}) {
    const double rate = 0.5, dt = 0.004, radius = 0.4;
    DropArrays drops(1);
    const auto record = [&](int n) {
      WiperSettings s;
      // One stroke from angle to angle + rate dt is one record with these ends.
      s.blades = {{{0.7, 0.0}, 0.16, 0.65, 40 * degree + rate * dt * n, rate * dt, 0}};
      s.half_width = 0.005;
      s.cycles_per_minute = 30 / dt;
      return wipers_between(s, glass.axes(), 0, dt, false);
    };
    const double start = 40 * degree;
    const Real2 place = glass.axes().to_glass({0.7 + radius * std::cos(start), radius * std::sin(start)});
    drops.u[0] = static_cast<float>(place[0]);
    drops.v[0] = static_cast<float>(place[1]);
    Capture capture{follow, 0.5, 0.25};
    const int steps = 200;
    for (int n = 0; n < steps; ++n) {
      const std::vector<Wiper> records = record(n);
      ASSERT_NEAR(records[0].rate, rate, 1e-4);
      wipe_drops(uniforms_of(records, false, 0, 0, capture), false, records, drops.spans(), nullptr, executor);
    }
    const Real2 p = glass.axes().to_plane({drops.u[0], drops.v[0]});
    const double angle = start + rate * dt * steps, rx = p[0] - 0.7, ry = p[1];
    const double ahead = std::cos(angle) * ry - std::sin(angle) * rx, reached = std::hypot(rx, ry);
    const double lag = 0.005 - ahead, speed = rate * reached;
    EXPECT_NEAR(lag, speed * dt * (1 - follow) / follow, 0.02 * speed * dt) << follow;
    EXPECT_NEAR(drops.mass[0], 1 + 0.25 * steps, 1e-4);
    // The velocity is the blade's: half of what is missing is made up each step.
    const Real2 velocity = glass.axes().to_plane({drops.velocity_u[0], drops.velocity_v[0]});
    EXPECT_NEAR(std::hypot(velocity[0], velocity[1]), speed, 0.02 * speed);
    EXPECT_LT(velocity[0], 0);
  }
}

// A drop that the blade leaps over at its edge: within the quad it is taken, in front and behind it is not; dead ones
// never.
TEST(MotionPublished, TakesWhatLiesInQuadOrCapsule) {
  const Glass glass = default_glass();
  const parallel::Executor executor(1);
  const WiperSettings s = inner_blade();
  const std::vector<Wiper> records = wipers_between(s, glass.axes(), 0.2, 0.25, false);
  const double a0 = wiper_angle(s.blades[0], 60, 0.2), a1 = wiper_angle(s.blades[0], 60, 0.25), turn = a1 - a0;
  struct Case {
    double angle, radius;
    float life;
    bool taken;
  };
  for (const Case& c :
       {Case{a0 + turn / 2, 0.3, 1, true}, Case{a1 + 0.015, 0.4, 1, true}, Case{a1 + 0.025, 0.4, 1, false}, Case{a0 - 0.01, 0.4, 1, false},
        Case{a0 + turn / 2, 0.62, 1, false}, Case{a1, 0.605, 1, true}, Case{a0 + turn / 2, 0.3, 0, false}}) {
    DropArrays drops(1);
    const Real2 place = glass.axes().to_glass({0.7 + c.radius * std::cos(c.angle), 0.08 + c.radius * std::sin(c.angle)});
    drops.u[0] = static_cast<float>(place[0]);
    drops.v[0] = static_cast<float>(place[1]);
    drops.life[0] = c.life;
    wipe_drops(uniforms_of(records, false), false, records, drops.spans(), nullptr, executor);
    EXPECT_EQ(drops.mass[0], c.taken ? 1.02f : 1.0f) << c.angle << " " << c.radius;
  }
}

}  // namespace
}  // namespace rainref::windshield
