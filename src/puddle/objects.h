// Objects that move through the water of a puddle, as records of the list of drops that describe their effect on the water.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "puddle/rainfall.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// A round object that presses on the water with a head of `depth` at its centre, in the shape of a crater. It rests before the first of
/// its places and after the last, and moves between them at constant speed.
struct MovingObject {
  struct Place {
    double time, x, z;  ///< [s], world [m]
  };
  double radius, depth;       ///< [m]; the shape ends at this distance
  std::vector<Place> places;  ///< at least one, in ascending time

  /// Its position at time t [s].
  Place at(double t) const;
};

/// "radius depth: time x z, time x z, ...; ..." Throws Error(usage) with the object and the key puddle.objects for any other text, more
/// than 64 objects, and lengths, times or places out of range.
std::vector<MovingObject> parse_objects(std::string_view text);

/// The effect of the objects on the water in each wave step. A moving pressure makes waves by its change: the head is subtracted where the
/// object was and added where it is, in both levels, like a drop's crater. So v = u - head obeys v_tt = c^2 lap(v + head). An object at
/// rest leaves the water level, its zero volume keeps the mean, and an object faster than the waves makes a wake within asin(c / speed).
class Objects {
 public:
  /// stored_per_metre: stored units per metre of height. Throws Error(usage) as parse_objects does.
  Objects(const Settings& settings, double stored_per_metre);

  /// The records of a wave step, for each object that moved in it: the negative head at its old position, then the head at its position at
  /// the end of the step. Each is followed by its images, as for a drop, if its centre lies in the water's rectangle. Positions are
  /// multiples of 1/1024 texel, so that a position gives the same record at the end of a step and at the start of the next.
  std::vector<Drop> records(std::int64_t step) const;

 private:
  std::vector<MovingObject> objects_;
  double step_rate_, cell_size_, stored_per_metre_;
  WaterEdges edges_;
};

}  // namespace rainref::puddle
