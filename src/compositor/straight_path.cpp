#include "compositor/straight_path.h"

#include <cmath>

#include "compositor/interface.h"
#include "scene/camera.h"

namespace rainref::compositor {

StraightPath straight_path(const Scene& scene, const Ray& ray, int most) {
  StraightPath path;
  path.origin = ray.origin;
  path.direction = rainref::scene::normalized(ray.direction);
  Ray now{path.origin, path.direction, ray.nearest, ray.farthest};
  std::uint32_t left = Hit::none;
  bool left_outside = false;
  while (true) {
    Hit hit;
    Vec normal{0, 0, 0};
    bool from_outside = false, contradicts = true;
    for (double step = 0x1p-52; contradicts && step < 1e-6; step *= 2) {
      hit = Hit{};
      scene.tracer().first_hits({&now, 1}, {&hit, 1});
      if (!hit.is_surface()) break;
      normal = scene.tracer().surface(hit.surface).normal(now, hit);
      from_outside = dot(now.direction, normal) < 0;
      contradicts = hit.surface == left && from_outside != left_outside;
      if (contradicts) now.nearest = hit.t + step * (1 + std::abs(now.origin.x) + std::abs(now.origin.y) + std::abs(now.origin.z));
    }
    if (!hit.is_surface()) {
      path.end = StraightPath::End::out;
      return path;
    }
    const Material& material = scene.material(hit.surface);
    if (material.opaque || path.interfaces == most) return path;
    const Split rays = cross_interface(material, {now.at(hit.t), now.direction, normal, 0, hit}, from_outside).rays;
    path.origin = now.at(hit.t);
    if (rays.refracted == Vec(0, 0, 0)) {
      path.end = StraightPath::End::mirrored;
      return path;
    }
    path.direction = rays.refracted;
    ++path.interfaces;
    now = Ray{path.origin, path.direction};
    left = hit.surface;
    left_outside = !from_outside;
  }
}

}  // namespace rainref::compositor
