// Rain and wind over time.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "windshield/motion/glass.h"
#include "windshield/motion/pchip.h"

namespace rainref::windshield {

/// One number of a row after the time.
struct KeyedQuantity {
  const char *name, *unit;
  double least, most;
};
/// Curves of the quantities, smooth between the rows without overshoot, and constant before the first and after the last row. Times in s.
/// Throws Error(usage) with `key` and the row: fewer than two rows, another count of numbers, a field that is not a number, times that do
/// not ascend, a value out of range.
std::vector<Pchip> parse_curves(std::string_view text, const std::string& key, std::span<const KeyedQuantity> quantities);

/// A stretch of the car's way [m], measured from its origin at time 0.
struct Stretch {
  double from, to;
};

struct WeatherSettings {
  Real3 wind{0, 0, 0};          ///< without key frames, world axes [m/s]
  std::string wind_key_frames;  ///< "time x y z; ..." in s and m/s; "": none
  double rain = 0;              ///< without key frames: [mm/h]; as-published drops per second on the whole windshield
  std::string rain_key_frames;  ///< "time rate; ..."; "": none
  double most_rain = 200;       ///< limit in key frames, and its unit
  const char* rain_unit = "mm/h";
  std::vector<Stretch> shelter;  ///< stretches without rain, ascending and disjoint (parse_shelter)
};

class Weather {
 public:
  /// Throws as parse_curves does.
  explicit Weather(const WeatherSettings& settings);

  /// World axes [m/s], at time t [s].
  Real3 wind(double t) const;
  /// The rain at time t [s], see WeatherSettings::rain.
  double rain(double t) const { return rain_.empty() ? settings_.rain : rain_.front().value(t); }
  bool rain_changes() const { return !rain_.empty(); }
  /// Its integral from time 0.
  double rained(double t) const { return rain_.empty() ? settings_.rain * t : rain_.front().integral(0, t); }

 private:
  WeatherSettings settings_;
  std::vector<Pchip> wind_, rain_;
};

}  // namespace rainref::windshield
