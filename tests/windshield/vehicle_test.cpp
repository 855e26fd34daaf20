// The car's motion: constant circles against geometry, tables against their curves, and what the passes take of it.
#include <gtest/gtest.h>

#include "windshield/support.h"
#include "source_folder.h"

namespace rainref::windshield {
namespace {

TEST(Vehicle, AConstantCircle) {
  VehicleSettings settings;
  settings.speed = 10;
  settings.yaw_rate = 0.25;
  settings.heading = 0.5;
  const VehicleState s = Vehicle(settings).at(3);
  EXPECT_EQ(s.speed, 10);
  EXPECT_EQ(s.distance, 30);
  EXPECT_EQ(s.heading, 0.5 + 0.25 * 3);
  EXPECT_EQ(s.acceleration, 0);
  EXPECT_NEAR(s.velocity[0], 10 * std::cos(1.25), 1e-14);
  EXPECT_NEAR(s.velocity[1], 10 * std::sin(1.25), 1e-14);
  // To the left, v^2 / r with r = v / yaw rate.
  EXPECT_EQ(s.body_acceleration, (Real3{0, 100 / (10 / 0.25), 0}));
}

// The acceleration in car axes is the derivative of the velocity in the world, turned by the heading.
TEST(Vehicle, BodyAccelerationIsTheDerivativeOfTheVelocity) {
  VehicleSettings settings;
  settings.key_frames = "0 0 0; 4 15 0.3; 9 12 -0.4; 14 0 0";
  const Vehicle car(settings);
  const double h = 1e-4;
  for (double t = 0.33; t < 13.9; t += 0.37) {
    const VehicleState now = car.at(t), before = car.at(t - h), after = car.at(t + h);
    const double ax = (after.velocity[0] - before.velocity[0]) / (2 * h), ay = (after.velocity[1] - before.velocity[1]) / (2 * h);
    const double c = now.direction[0], s = now.direction[1];
    EXPECT_NEAR(c * ax + s * ay, now.body_acceleration[0], 1e-5) << t;
    EXPECT_NEAR(c * ay - s * ax, now.body_acceleration[1], 1e-5) << t;
    EXPECT_NEAR((after.distance - before.distance) / (2 * h), now.speed, 1e-5) << t;
    EXPECT_NEAR((after.heading - before.heading) / (2 * h), now.yaw_rate, 1e-6) << t;
    EXPECT_NEAR((after.yaw_rate - before.yaw_rate) / (2 * h), now.yaw_acceleration, 1e-6) << t;
  }
}

TEST(Vehicle, StartMovesTheTableAndItsEndHoldsTheLastSpeed) {
  VehicleSettings settings;
  settings.key_frames = "0 0; 10 10; 20 5";
  settings.start = 10;
  const Vehicle car(settings);
  EXPECT_EQ(car.at(0).speed, 10);
  EXPECT_EQ(car.at(0).distance, 0);
  EXPECT_EQ(car.at(10).speed, 5);
  EXPECT_EQ(car.at(50).speed, 5);
  EXPECT_EQ(car.at(50).acceleration, 0);
  EXPECT_NEAR(car.at(50).distance - car.at(10).distance, 200, 1e-12);
}

TEST(Vehicle, TwoTablesAreRefused) {
  VehicleSettings settings;
  settings.key_frames = "0 0; 1 1";
  settings.drive_cycle = "a.csv";
  EXPECT_EQ(usage_error([&] { Vehicle car(settings); }),
            "vehicle.drive_cycle and vehicle.key_frames: expected one of them, found 'a.csv' and '0 0; 1 1'");
}

TEST(Vehicle, ADriveCycleDrives) {
  VehicleSettings settings;
  settings.drive_cycle = rainref::test::source_folder() + "/scenes/windshield/cycles/us06.csv";
  const Vehicle car(settings);
  EXPECT_NEAR(car.at(600).distance, 12887.6, 0.05);
  double most = 0, least = 0;
  for (int i = 0; i < 6000; ++i) {
    most = std::max(most, car.at(0.1 * i).acceleration);
    least = std::min(least, car.at(0.1 * i).acceleration);
  }
  // Chords of US06 lie in [-3.09, 3.76] m/s^2; the steepest point of a cubic with limited slopes is at most 1.5 chords.
  EXPECT_GT(most, 3.7);
  EXPECT_LT(most, 1.5 * 3.76);
  EXPECT_LT(least, -3.0);
  EXPECT_GT(least, -1.5 * 3.09);
}

}  // namespace
}  // namespace rainref::windshield
