// What a smooth interface between two media does to a ray.
#pragma once

#include "compositor/optics.h"
#include "compositor/scene.h"

namespace rainref::compositor {

/// The two rays that an interface makes of one; directions unit.
struct Split {
  Vec reflected, refracted;  ///< refracted is zero beyond the critical angle
  double reflectance;        ///< Fresnel's, of unpolarized light, in [0, 1]; 1 beyond the critical angle
};
/// direction and normal are unit, the normal against the ray; ior_from is on the ray's side. Within a few roundings.
inline Split split(const Vec& direction, const Vec& normal, double ior_from, double ior_to) {
  using namespace scalar;
  const auto d = number(direction), n = number(normal);
  const auto bent = refract(d, n, ior_from / ior_to);
  Split out{vec(reflect(d, n)), vec(bent), 1};
  if (out.refracted == Vec(0, 0, 0)) return out;
  // Fresnel's equations are the same both ways; the text wants them seen from the thinner medium.
  out.reflectance = ior_from <= ior_to ? fresnel_dielectric(-dot(n, d), ior_to / ior_from).v : fresnel_dielectric(-dot(n, bent), ior_from / ior_to).v;
  return out;
}

/// What a material that is an interface does to the ray that met it, and the normal that decided, against the ray.
struct Crossing {
  Split rays;
  Vec normal;
};
/// is_outside: the ray comes from the side of at.normal. Where the smooth normal would send a ray through the facet, the
/// geometric one decides.
inline Crossing cross_interface(const Material& material, const Place& at, bool is_outside) {
  const double here = (is_outside ? material.outside : material.inside).ior, beyond = (is_outside ? material.inside : material.outside).ior;
  const Vec facing = is_outside ? at.normal : -at.normal;
  if (material.smooth_normal) {
    const Vec outward = material.smooth_normal(at), smooth = is_outside ? outward : -outward;
    if (dot(at.direction, smooth) < 0) {
      const Split rays = split(at.direction, smooth, here, beyond);
      if (dot(rays.reflected, facing) > 0 && !(dot(rays.refracted, facing) > 0)) return {rays, smooth};
    }
  }
  return {split(at.direction, facing, here, beyond), facing};
}

}  // namespace rainref::compositor
