// Objects that move through the water of a puddle: how they disturb it, as records of the drops' list.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "puddle/rainfall.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// A round object that presses on the water with a head of `depth` in its middle, of the shape of a crater. It rests before the first of
/// its places and after the last, and between goes from one to the next at an even speed.
struct MovingObject {
  struct Place {
    double time, x, z;  ///< [s], world [m]
  };
  double radius, depth;       ///< [m]; the shape ends at this distance
  std::vector<Place> places;  ///< at least one, times ascending

  /// Where it is at time t [s].
  Place at(double t) const;
};

/// "radius depth: time x z, time x z, ...; ..." Throws Error(usage), naming the object and the key puddle.objects, for any other text, more
/// than 64 objects, and lengths, times or places beyond what they may be.
std::vector<MovingObject> parse_objects(std::string_view text);

/// What the objects do to the water in each wave step. A pressure that moves makes waves by its change: the head is taken from where the
/// object was and added where it is, into both levels, as a drop's crater is. So v = u - head obeys v_tt = c^2 lap(v + head): an object
/// that rests leaves the water level, its volume of 0 keeps the mean, and one that is faster than the waves draws a wake within asin(c /
/// speed).
class Objects {
 public:
  /// stored_per_metre: stored units in a metre of height. Throws Error(usage) as parse_objects does.
  Objects(const Settings& settings, double stored_per_metre);

  /// The records of a wave step, of each object that moved in it: the head that it leaves, negative, then the head where it is at the
  /// step's end, each followed by its images as a drop is, as far as its middle lies in the water's rectangle. Places are multiples of
  /// 1/1024 texel, so that a place is the same record at the end of a step and at the start of the next.
  std::vector<Drop> records(std::int64_t step) const;

 private:
  std::vector<MovingObject> objects_;
  double step_rate_, cell_size_, stored_per_metre_;
  WaterEdges edges_;
};

}  // namespace rainref::puddle
