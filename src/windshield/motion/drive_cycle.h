// Speeds over time from a table: a drive cycle in a CSV file, or key frames in a scene.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "windshield/motion/pchip.h"

namespace rainref::windshield {

constexpr double largest_speed = 100;    ///< [m/s]: tables in km/h are caught here
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
/// The same of a file. Throws Error(io) when it cannot be read.
DriveCycle read_drive_cycle(const std::filesystem::path& file);

/// "0 0; 10 13.9; 20 0": rows of time [s], speed [m/s] and, optionally in all of them, yaw rate [rad/s]. Throws
/// Error(usage) as parse_drive_cycle does, naming `key` and the row.
DriveCycle parse_key_frames(std::string_view text, const std::string& key);

}  // namespace rainref::windshield
