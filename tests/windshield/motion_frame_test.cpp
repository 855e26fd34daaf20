// Pass windshield_frame against mechanics: projections (physics: W1, W2), Galilean invariance and equivalence (W3), a
// free body seen from a turning car.
#include <gtest/gtest.h>

#include "windshield/scalar.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

using drops::GlassFrame;
constexpr double g = 9.80665;

GlassFrame frame_of(const Glass& glass, const VehicleState& car, bool corrected, const Real3& wind = {0, 0, 0}, double gravity = g) {
  return windshield_frame(windshield_frame_uniforms(glass, car, wind, gravity, corrected), corrected);
}
VehicleState parked() {
  VehicleSettings s;
  s.speed = 0;
  return Vehicle(s).at(0);
}
VehicleState driving(double speed, double acceleration = 0, double yaw_rate = 0) {
  VehicleState s = parked();
  s.speed = speed;
  s.velocity = {speed, 0, 0};
  s.yaw_rate = yaw_rate;
  s.body_acceleration = {acceleration, speed * yaw_rate, 0};
  return s;
}

// Corners whose metric and its inverse are short binary fractions, so that no uniform is rounded: G = (4 -2; -2 3),
// det 8.
TEST(MotionFrame, ProjectsExactlyOnAShearedGlass) {
  const Glass glass = make_glass({{{1, 2, 0.5}, {1, 0, 0.5}, {0, 3, 1.5}}});
  ASSERT_EQ(glass.metric, (std::array<double, 3>{4, -2, 3}));
  ASSERT_EQ(glass.inverse_metric, (std::array<double, 3>{0.375, 0.25, 0.5}));
  std::mt19937 random(2);
  std::uniform_real_distribution<float> number(-1, 1);
  for (int round = 0; round < 100; ++round) {
    const Real3 f{number(random), number(random), number(random)};
    const WindshieldFrameUniforms u = windshield_frame_uniforms(glass, parked(), f, 0, true);
    const auto out = scalar::windshield_frame_corrected<scalar::Scalar<double>>(u);
    // J a = f - (f . n) n
    const double normal_part = dot(f, glass.normal);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(out.wind[0].v * glass.e_u[k] + out.wind[1].v * glass.e_v[k], f[k] - normal_part * glass.normal[k], 1e-14);
    }
  }
}
TEST(MotionFrame, FloatsKeepTheProjectionToOneInAMillion) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  int checked = 0;
  while (checked < 300) {
    const auto vector = [&] { return Real3{number(random), number(random), number(random)}; };
    const Glass glass = make_glass({vector(), vector(), vector()});
    const double condition = glass.metric[0] * glass.metric[2] / (glass.area * glass.area);
    if (condition > 10) continue;
    ++checked;
    const Real3 f = vector();
    const GlassFrame out = frame_of(glass, parked(), true, f, 0);
    const double normal_part = dot(f, glass.normal);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(out.wind[0] * glass.e_u[k] + out.wind[1] * glass.e_v[k], f[k] - normal_part * glass.normal[k], 1e-6 * condition);
    }
  }
}

// As published a force down a glass whose axes enclose phi is turned by 90 - phi degrees and weakened to sin phi;
// corrected it is kept.
TEST(MotionFrame, AsPublishedShearTurnsForces) {
  for (const double phi : {85.0, 80.0, 70.0}) {
    const double c = std::cos(phi * degree), s = std::sin(phi * degree);
    // An upright pane: e_u to the right, e_v up and leaning; the force is straight down.
    const Glass glass = make_glass({{{0, 0, 0}, {0, -1, 0}, {0, -c, s}}});
    for (const bool corrected : {false, true}) {
      const GlassFrame out = frame_of(glass, parked(), corrected, {0, 0, 0}, 1);
      const double y = -out.gravity[0] - c * out.gravity[1], z = s * out.gravity[1];
      EXPECT_NEAR(std::atan2(std::abs(y), -z) / degree, corrected ? 0 : 90 - phi, 1e-5) << phi;
      EXPECT_NEAR(std::hypot(y, z), corrected ? 1 : s, 1e-6) << phi;
    }
  }
}

// Inclined by beta: gravity -g sin beta, head wind U cos beta up the glass, inertia; all over the length of the axis.
TEST(MotionFrame, DrivingOnTheDefaultGlass) {
  for (const double beta : {27.0, 30.0}) {
    const double s = std::sin(beta * degree), c = std::cos(beta * degree);
    const Glass glass = make_glass(corners_at(beta * degree));
    for (const bool corrected : {false, true}) {
      const GlassFrame still = frame_of(glass, parked(), corrected);
      EXPECT_NEAR(still.gravity[0], 0, 1e-6);
      EXPECT_NEAR(still.gravity[1], -g * s / 0.8, 2e-6);
      EXPECT_EQ(still.wind[1], 0);
      const GlassFrame fast = frame_of(glass, driving(20), corrected);
      EXPECT_NEAR(fast.wind[1], 20 * c / 0.8, 4e-6);
      EXPECT_NEAR(fast.wind[0], 0, 1e-6);
      // What a drop feels of the car's own acceleration.
      const auto inertia = [&](const VehicleState& car, int axis) {
        const GlassFrame out = frame_of(glass, car, corrected);
        return out.gravity[axis] - still.gravity[axis] - out.acceleration[axis];
      };
      EXPECT_NEAR(inertia(driving(10, 3), 1), 3 * c / 0.8, 4e-6) << "speeding up: up the glass";
      EXPECT_NEAR(inertia(driving(10, -5), 1), -5 * c / 0.8, 4e-6) << "braking: down";
      VehicleState left = driving(10, 0, 0.3);
      if (corrected) left.yaw_rate = 0;  // the rest of a turn is tested below
      EXPECT_NEAR(inertia(left, 0), 3 / 1.4, 4e-6) << "a turn to the left: to the right";
      EXPECT_NEAR(inertia(left, 1), 0, 1e-6);
    }
  }
}

// Wind and car faster by the same: the same bits where the sums are exact, and a car that moves with the wind is parked
// in calm air.
TEST(MotionFrame, OnlyApparentWindCounts) {
  const Glass glass = default_glass();
  for (const bool corrected : {false, true}) {
    VehicleState car = driving(12.5);
    const GlassFrame before = frame_of(glass, car, corrected, {3, -2, 0.25});
    car.velocity = {12.5 + 7.75, 1.5, 0};
    const GlassFrame after = frame_of(glass, car, corrected, {3 + 7.75, -2 + 1.5, 0.25});
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(after.wind[k], before.wind[k]);
      EXPECT_EQ(after.gravity[k], before.gravity[k]);
      EXPECT_EQ(after.acceleration[k], before.acceleration[k]);
    }
    const GlassFrame with_wind = frame_of(glass, driving(12.5), corrected, {12.5, 0, 0}), calm = frame_of(glass, parked(), corrected);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(with_wind.wind[k], 0);
      EXPECT_EQ(with_wind.gravity[k], calm.gravity[k]);
    }
  }
}

TEST(MotionFrame, TheHeadingTurnsTheWind) {
  const Glass glass = default_glass();
  VehicleSettings settings;
  settings.speed = 0;
  settings.heading = 30 * degree;
  const VehicleState car = Vehicle(settings).at(0);
  // Wind from dead ahead, and from the right.
  const Real3 ahead{-8 * std::cos(30 * degree), -8 * std::sin(30 * degree), 0},
      from_right{-8 * std::sin(30 * degree), 8 * std::cos(30 * degree), 0};
  for (const bool corrected : {false, true}) {
    EXPECT_NEAR(frame_of(glass, car, corrected, ahead).wind[1], 8 * std::cos(27 * degree) / 0.8, 3e-6);
    EXPECT_NEAR(frame_of(glass, car, corrected, ahead).wind[0], 0, 3e-6);
    EXPECT_NEAR(frame_of(glass, car, corrected, from_right).wind[0], -8 / 1.4, 3e-6);  // to the left
    EXPECT_NEAR(frame_of(glass, car, corrected, from_right).wind[1], 0, 3e-6);
  }
}

// Level braking at a is being parked on a slope of atan(a / g), nose down, under sqrt(a^2 + g^2): the same forces on
// the glass.
TEST(MotionFrame, BrakingIsASlope) {
  for (const double a : {1.0, 4.0, 8.0}) {
    const double phi = std::atan(a / g), c = std::cos(phi), s = std::sin(phi);
    std::array<Real3, 3> corners = corners_at(27 * degree);
    const GlassFrame braking = frame_of(make_glass(corners), driving(0, -a), true);
    // The car's axes seen from level ones: x dips by phi.
    for (Real3& p : corners) p = {c * p[0] + s * p[2], p[1], c * p[2] - s * p[0]};
    const GlassFrame sloped = frame_of(make_glass(corners), parked(), true, {0, 0, 0}, std::hypot(a, g));
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(braking.gravity[k], sloped.gravity[k], 5e-6) << a;
    EXPECT_EQ(braking.acceleration[0], 0);
    EXPECT_EQ(braking.acceleration[1], 0);
  }
}

// A body at rest in the world, seen from a car that speeds up and turns, with a level pane: its acceleration in glass
// coordinates is gravity + spin uv + coriolis vel of the frame, by differences of its path.
TEST(MotionFrame, AFreeBodyStaysWhereItIs) {
  const Glass glass = make_glass({{{1.5, 0.7, 1}, {1.4, -0.6, 1}, {2.3, 0.9, 1}}});
  VehicleSettings settings;
  settings.key_frames = "0 3 0.1; 4 12 0.9; 9 6 -0.6; 12 8 0.2";
  const Vehicle car(settings);
  const double h = 2e-3;
  for (double t = 0.5; t < 11.5; t += 0.43) {
    // The car's way from t to t + d, by Simpson's rule.
    const auto way = [&](double d, int axis) {
      return d / 6 * (car.at(t).velocity[axis] + 4 * car.at(t + d / 2).velocity[axis] + car.at(t + d).velocity[axis]);
    };
    const Real2 body{5, -3};  // from the car, at time t, in the world
    const auto seen = [&](double d) {
      const VehicleState s = car.at(t + d);
      const double wx = body[0] - way(d, 0), wy = body[1] - way(d, 1);
      const double x = s.direction[0] * wx + s.direction[1] * wy - glass.origin[0],
                   y = s.direction[0] * wy - s.direction[1] * wx - glass.origin[1];
      const double along_u = x * glass.e_u[0] + y * glass.e_u[1], along_v = x * glass.e_v[0] + y * glass.e_v[1];
      return Real2{glass.inverse_metric[0] * along_u + glass.inverse_metric[1] * along_v,
                   glass.inverse_metric[1] * along_u + glass.inverse_metric[2] * along_v};
    };
    const Real2 before = seen(-h), now = seen(0), after = seen(h);
    const GlassFrame out = frame_of(glass, car.at(t), true);
    for (int k = 0; k < 2; ++k) {
      const double velocity[2] = {(after[0] - before[0]) / (2 * h), (after[1] - before[1]) / (2 * h)};
      const double acceleration = (after[k] - 2 * now[k] + before[k]) / (h * h);
      const double force = out.gravity[k] + out.spin[2 * k] * now[0] + out.spin[2 * k + 1] * now[1] + out.coriolis[2 * k] * velocity[0] +
                           out.coriolis[2 * k + 1] * velocity[1];
      // Second differences are off by h^2 / 12 of the fourth derivative, some 100 / s^4 here, and floats by 1e-7 of
      // terms up to 50.
      EXPECT_NEAR(force, acceleration, 1e-3) << t;
    }
  }
}

// The reference differs from real arithmetic by the rounding of a few products: 1e-6 of the largest force.
TEST(MotionFrame, FloatsAreNearTheDoubleReading) {
  VehicleState car = driving(30, -4, 0.7);
  car.yaw_acceleration = -1.3;
  for (const bool corrected : {false, true}) {
    const WindshieldFrameUniforms u = windshield_frame_uniforms(default_glass(), car, {3, -4, 1}, g, corrected);
    const GlassFrame out = windshield_frame(u, corrected);
    using D = scalar::Scalar<double>;
    const auto real = corrected ? scalar::windshield_frame_corrected<D>(u) : scalar::windshield_frame_as_published<D>(u);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(out.gravity[k], real.gravity[k].v, 1e-5);
      EXPECT_NEAR(out.wind[k], real.wind[k].v, 4e-5);
      EXPECT_NEAR(out.acceleration[k], real.acceleration[k].v, 1e-5);
    }
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(out.spin[k], real.spin[k].v, 1e-6);
      EXPECT_NEAR(out.coriolis[k], real.coriolis[k].v, 1e-6);
    }
  }
}

}  // namespace
}  // namespace rainref::windshield
