// Bridges and tunnels over the road: stretches of the car's way without rain.
#pragma once

#include <string_view>
#include <vector>

#include "windshield/motion/vehicle.h"
#include "windshield/motion/weather.h"

namespace rainref::windshield {

/// "from to; from to; ..." in m, stretches in any order; stretches that overlap or touch are joined. Ascending. Throws Error(usage) with
/// the stretch and the key rain.shelter for any other text, more than 64 stretches, and ends in the wrong order or beyond 10 000 km.
std::vector<Stretch> parse_shelter(std::string_view text);

/// Whether a stretch covers a position on the way [m]; it includes its beginning, but not its end.
bool is_covered(const std::vector<Stretch>& roofs, double place);

/// Times at which a point of the car is under the roofs.
class Shelter {
 public:
  /// roofs: the result of parse_shelter; ahead: distance of the point before the car's origin [m].
  Shelter(const std::vector<Stretch>& roofs, const Vehicle& vehicle, double ahead);

  /// Share of the time between `from` and a later `to` [s], neither negative, that it is in the open: exactly 1 or 0 if it is all or none.
  double open_share(double from, double to) const;
  /// True if it was always in the open until t.
  bool is_open_until(double t) const { return covered_.empty() || !(covered_.front().from < t); }
  /// The part of Weather::rained(t) that fell in the open.
  double rained(const Weather& weather, double t) const;

 private:
  struct Interval {
    double from, to;  ///< [s]; to: infinity if it never ends
  };
  std::vector<Interval> covered_;  // ascending, disjoint
};

}  // namespace rainref::windshield
