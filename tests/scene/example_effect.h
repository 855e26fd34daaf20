// An effect with a parameter of each type, for the tests of this room.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/error_of.h"
#include "scene/effect_table.h"

namespace rainref::scene {

inline const std::vector<Parameter>& puddle_parameters() {
  constexpr double none = std::numeric_limits<double>::infinity();
  static const std::vector<Parameter> parameters{
      real("puddle.damping", "1", 0.95, 0.999, 0.99, "Share of the height kept from one step to the next.").default_for("corrected", 0.995),
      integer("puddle.drop_count", "1", 0, 1000, 10, "Drops in flight at once."),
      real("puddle.wave_speed", "m/s", 0, none, 0.25, "Speed of long waves.").only("corrected"),
      boolean("puddle.printed", false, "Whether to keep the misprint.").only("as-published"),
      choice("puddle.blend", {"add", "max"}, "add", "How drops that overlap combine."),
      text("puddle.ground", "", "Image file of the ground; empty for the checkerboard."),
      real2("puddle.extent", "m", 0.1, 100, {2, 1}, "Width and depth of the puddle."),
      real3("camera.position", "m", -none, none, {0, 1, 0}, "Where the camera is."),
  };
  return parameters;
}

inline EffectTable example_effects() {
  return {{{"puddle", {"as-published", "corrected"}, puddle_parameters()}, {"windshield", {"as-published", "corrected"}, {}}}};
}

}  // namespace rainref::scene
