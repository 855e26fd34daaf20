// The motion of the car: speed and yaw over time, and derived values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "windshield/motion/glass.h"
#include "windshield/motion/pchip.h"

namespace rainref::windshield {

constexpr double largest_speed = 100;    ///< [m/s]; catches tables in km/h
constexpr double largest_yaw_rate = 10;  ///< [rad/s]

/// Speed and yaw rate over time [s]; constant before the first and after the last row.
struct DriveCycle {
  Pchip speed;     ///< [m/s]
  Pchip yaw_rate;  ///< [rad/s], positive to the left
};

/// Reads CSV: a header with the columns time_s, speed_mps and, optionally, yaw_rad_s (a rate) in any order, then rows
/// of numbers. Blank lines, lines that begin with #, spaces around fields and CRLF are accepted. Throws Error(usage)
/// with file and line: a missing, repeated or unknown column, a field that is not a finite number, times that do not
/// ascend, a speed outside [0, largest_speed], a yaw rate beyond +-largest_yaw_rate, fewer than two rows.
DriveCycle parse_drive_cycle(std::string_view csv, const std::string& file);
/// The same for a file. Throws Error(io) if it cannot be read.
DriveCycle read_drive_cycle(const std::filesystem::path& file);

/// "0 0; 10 13.9; 20 0": rows of time [s], speed [m/s] and, optionally in all rows, yaw rate [rad/s]. Throws Error(usage) as
/// parse_drive_cycle does, with `key` and the row.
DriveCycle parse_key_frames(std::string_view text, const std::string& key);

/// The car at one time. World axes are the car's axes rotated about z by the heading. All values hold at the origin of the car's axes,
/// which does not slip sideways (the middle of the rear axle).
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
  /// Reads and checks the table, if there is one. Throws as parse_key_frames and read_drive_cycle do, and Error(usage) if there are two.
  explicit Vehicle(const VehicleSettings& settings);

  /// The state at time t [s]. In the table's range speed and yaw rate are C1, and their derivatives and integrals are exact; outside it
  /// both are constant.
  VehicleState at(double t) const;

 private:
  VehicleSettings settings_;
  std::optional<DriveCycle> cycle_;
};

}  // namespace rainref::windshield
