// The first hit of a ray in the street.
#pragma once

#include "night_street/vec.h"

namespace rainref::night_street {

struct City;

struct Hit {
  enum Kind : std::uint8_t { sky, road, pavement, kerb, building, solid, skyline } kind = sky;
  double t = 0;   ///< metres along the ray; 0 for sky
  Vec normal;     ///< unit, geometric; zero for sky
  int side = 0;   ///< building: row 0 (x < 0) or 1
  int index = 0;  ///< building: lot; solid: index in City::solids
  bool is_surface() const { return kind != sky; }
  /// Equal for two hits only if they are on the same object.
  std::uint32_t object() const { return static_cast<std::uint32_t>(kind) << 24 ^ static_cast<std::uint32_t>(2 * index + side); }
};

/// The nearest surface. Lamps (emissive spheres) are ignored if with_lamps is false.
Hit trace(const City& city, const Ray& ray, bool with_lamps = true);

}  // namespace rainref::night_street
