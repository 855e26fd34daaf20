// Radiance along a ray: surface, wet reflection, haze.
#pragma once

#include "night_street/trace.h"
#include "night_street/vec.h"

namespace rainref::night_street {

/// Linear radiance that reaches the ray's origin, and the object that the ray hit. A pure function of the street and the ray.
struct Seen {
  Vec radiance;
  Hit hit;
};
Seen look(const City& city, const Ray& ray);

}  // namespace rainref::night_street
