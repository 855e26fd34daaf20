#include "windshield/motion/vehicle.h"

#include <fmt/format.h>

#include "math/real64.h"
#include "rainref/error.h"

namespace rainref::windshield {

Vehicle::Vehicle(const VehicleSettings& settings) : settings_(settings) {
  if (!settings.drive_cycle.empty() && !settings.key_frames.empty()) {
    throw Error(ExitCode::usage, fmt::format("vehicle.drive_cycle and vehicle.key_frames: expected one of them, found '{}' and '{}'",
                                             settings.drive_cycle.string(), settings.key_frames));
  }
  if (!settings.drive_cycle.empty()) cycle_ = read_drive_cycle(settings.drive_cycle);
  if (!settings.key_frames.empty()) cycle_ = parse_key_frames(settings.key_frames, "vehicle.key_frames");
}

VehicleState Vehicle::at(double t) const {
  VehicleState s{};
  if (cycle_) {
    const double from = settings_.start, now = settings_.start + t;
    s.speed = cycle_->speed.value(now);
    s.acceleration = cycle_->speed.derivative(now);
    s.distance = cycle_->speed.integral(from, now);
    s.yaw_rate = cycle_->yaw_rate.value(now);
    s.yaw_acceleration = cycle_->yaw_rate.derivative(now);
    s.heading = settings_.heading + cycle_->yaw_rate.integral(from, now);
  } else {
    s.speed = settings_.speed;
    s.distance = settings_.speed * t;
    s.yaw_rate = settings_.yaw_rate;
    s.heading = settings_.heading + settings_.yaw_rate * t;
  }
  s.direction = {cos_real(Real64(s.heading)).v, sin_real(Real64(s.heading)).v};
  s.velocity = {s.speed * s.direction[0], s.speed * s.direction[1], 0};
  s.body_acceleration = {s.acceleration, s.speed * s.yaw_rate, 0};
  return s;
}

}  // namespace rainref::windshield
