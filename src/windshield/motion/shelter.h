// Bridges and tunnels that the car drives under: stretches of its way where no rain falls.
#pragma once

#include <string_view>
#include <vector>

#include "windshield/motion/vehicle.h"
#include "windshield/motion/weather.h"

namespace rainref::windshield {

/// "from to; from to; ..." in m, stretches in any order; those that overlap or touch become one. Ascending. Throws Error(usage), naming
/// the stretch and the key rain.shelter, for any other text, more than 64 stretches, and ends in the other order or beyond 10 000 km.
std::vector<Stretch> parse_shelter(std::string_view text);

/// Whether a stretch covers a place on the way [m]: its beginning, not its end.
bool is_covered(const std::vector<Stretch>& roofs, double place);

/// When something that is carried by the car is under the roofs.
class Shelter {
 public:
  /// roofs: as parse_shelter gives them; ahead: how far before the car's origin it is [m].
  Shelter(const std::vector<Stretch>& roofs, const Vehicle& vehicle, double ahead);

  /// Share of the time from `from` to a later `to` [s], neither before 0, in which it is in the open: exactly 1 and 0 where it is all or
  /// none of it.
  double open_share(double from, double to) const;
  /// Whether it was in the open all the time until t.
  bool is_open_until(double t) const { return covered_.empty() || !(covered_.front().from < t); }
  /// What of Weather::rained(t) fell in the open.
  double rained(const Weather& weather, double t) const;

 private:
  struct Interval {
    double from, to;  ///< [s]; to: infinite for what never ends
  };
  std::vector<Interval> covered_;  // ascending, apart
};

}  // namespace rainref::windshield
