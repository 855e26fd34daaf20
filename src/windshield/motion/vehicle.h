// How the car moves: speed and yaw over time, and what follows from them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "windshield/motion/drive_cycle.h"
#include "windshield/motion/glass.h"

namespace rainref::windshield {

/// The car at one time. World axes are the car's, turned about z by the heading. All of it holds at the origin of the
/// car's axes, which does not slip sideways (the middle of the rear axle).
struct VehicleState {
  double speed;             ///< forward [m/s]
  double acceleration;      ///< derivative of speed [m/s^2]
  double yaw_rate;          ///< positive to the left [rad/s]
  double yaw_acceleration;  ///< derivative of yaw_rate [rad/s^2]
  double heading;           ///< integral of yaw_rate, from settings.heading at time 0 [rad]
  double distance;          ///< integral of speed, from 0 at time 0 [m]
  Real2 direction;          ///< cosine and sine of heading
  Real3 velocity;           ///< world axes [m/s]
  Real3 body_acceleration;  ///< car axes: along the car, v times yaw rate to the left, 0 [m/s^2]
};

struct VehicleSettings {
  double speed = 13.9;                ///< without a table [m/s]
  double yaw_rate = 0;                ///< without a table [rad/s]
  double heading = 0;                 ///< at time 0 [rad]
  double start = 0;                   ///< time in the table at time 0 [s]
  std::string key_frames;             ///< a table in the scene; "": none
  std::filesystem::path drive_cycle;  ///< a table in a CSV file; "": none
};

class Vehicle {
 public:
  /// Reads and checks the table, if there is one. Throws as parse_key_frames and read_drive_cycle do, and Error(usage)
  /// when there are two.
  explicit Vehicle(const VehicleSettings& settings);

  /// The state at time t [s]. Speed and yaw rate are C1 in the table's range, their derivatives and integrals exact;
  /// beyond it both are held.
  VehicleState at(double t) const;

 private:
  VehicleSettings settings_;
  std::optional<DriveCycle> cycle_;
};

}  // namespace rainref::windshield
