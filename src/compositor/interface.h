// Reflection and refraction of one ray at a smooth interface between two media.
#pragma once

#include "compositor/optics.h"
#include "compositor/scene.h"

namespace rainref::compositor {

namespace scalar {
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "compositor/interface-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace scalar

/// The two rays that result at an interface; directions are unit vectors.
struct Split {
  Vec reflected, refracted;  ///< refracted is zero beyond the critical angle
  double reflectance;        ///< Fresnel's, for unpolarized light, in [0, 1]; 1 beyond the critical angle
};
inline Split split_of(const scalar::SplitOf<scalar::Number>& s) {
  return {scalar::vec(s.reflected), scalar::vec(s.refracted), s.reflectance.v};
}
/// direction and normal are unit, the normal against the ray; ior_from is on the ray's side. Accurate to a few roundings.
inline Split split(const Vec& direction, const Vec& normal, double ior_from, double ior_to) {
  using namespace scalar;
  return split_of(scalar::split(number(direction), number(normal), Number(ior_from), Number(ior_to)));
}

/// The rays that result from a ray at an interface, and the normal that was used, against the ray.
struct Crossing {
  Split rays;
  Vec normal;
};
/// is_outside: the ray comes from the side of at.normal.
inline Crossing cross_interface(const Material& material, const Place& at, bool is_outside) {
  using namespace scalar;
  const double here = (is_outside ? material.outside : material.inside).ior, beyond = (is_outside ? material.inside : material.outside).ior;
  const Vec facing = is_outside ? at.normal : -at.normal;
  if (!material.smooth_normals) return {compositor::split(at.direction, facing, here, beyond), facing};
  const Vec outward = smooth_normal(material, at);
  const auto crossing =
      cross_facet(number(at.direction), number(facing), number(is_outside ? outward : -outward), Number(here), Number(beyond));
  return {split_of(crossing.rays), vec(crossing.normal)};
}

}  // namespace rainref::compositor
