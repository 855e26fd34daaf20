// Wet asphalt and paving: standing water, roughness of the film, road markings.
#pragma once

#include "night_street/trace.h"
#include "night_street/vec.h"

namespace rainref::night_street {

struct WetGround {
  Vec albedo;        ///< of the ground below the film
  double water;      ///< 0 wet film ... 1 standing water
  double roughness;  ///< GGX alpha of the film
  Vec normal;        ///< unit: ripples and rings of fresh drops
};

/// The ground at `point` seen from `distance` metres. kind is Hit::road or Hit::pavement.
WetGround wet_ground(const City& city, Hit::Kind kind, const Vec& point, double distance);

}  // namespace rainref::night_street
