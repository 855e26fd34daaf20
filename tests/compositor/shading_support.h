// Surfaces with closed forms, for tests of shading: an endless level plane, a ball, a disc.
#pragma once

#include <cmath>
#include <memory>

#include "compositor/shading.h"

namespace rainref::compositor::testing {

/// y = height, outside above; endless for rays that stay within 10 km.
class Level : public Surface {
 public:
  explicit Level(double height) : height_(height) {}
  std::uint32_t primitives() const override { return 1; }
  Box bounds(std::uint32_t) const override { return {{-1e4, height_, -1e4}, {1e4, height_, 1e4}}; }
  void meet(std::uint32_t self, std::uint32_t, const Ray& ray, Hit& first) const override {
    if (ray.direction.y == 0) return;
    const Hit hit{(height_ - ray.origin.y) / ray.direction.y, self, 0, 0, 0};
    if (hit.t >= ray.nearest && hit.t <= ray.farthest && precedes(hit, first)) first = hit;
  }
  Vec normal(const Ray&, const Hit&) const override { return {0, 1, 0}; }

 private:
  double height_;
};

/// A ball, or the part of it above y = floor.
class Ball : public Surface {
 public:
  Ball(const Vec& centre, double radius, double floor = -1e300) : centre_(centre), radius_(radius), floor_(floor) {}
  std::uint32_t primitives() const override { return 1; }
  Box bounds(std::uint32_t) const override { return {centre_ - radius_, centre_ + radius_}; }
  void meet(std::uint32_t self, std::uint32_t, const Ray& ray, Hit& first) const override {
    const Vec o = ray.origin - centre_;
    const double a = dot(ray.direction, ray.direction), b = dot(o, ray.direction), c = dot(o, o) - radius_ * radius_, q = b * b - a * c;
    if (q < 0) return;
    const double root = std::sqrt(q);
    for (const double t : {(-b - root) / a, (-b + root) / a}) {
      const Hit hit{t, self, 0, 0, 0};
      if (t < ray.nearest || t > ray.farthest || ray.at(t).y < floor_) continue;
      if (precedes(hit, first)) first = hit;
      return;
    }
  }
  Vec normal(const Ray& ray, const Hit& hit) const override { return (ray.at(hit.t) - centre_) / radius_; }

 private:
  Vec centre_;
  double radius_, floor_;
};

/// Radiance that tells where a ray ran: the coordinates of the place.
inline std::shared_ptr<const Opaque> tells_place() {
  return opaque_of([](const Place& p) {
    Finish f;
    f.radiance = p.point;
    return f;
  });
}
/// Surroundings that tell the direction of the ray.
inline std::shared_ptr<const Environment> tells_direction() {
  return environment_of([](const EscapedRay& s) { return s.direction; });
}
inline std::shared_ptr<const Environment> constant(const Vec& radiance) {
  return environment_of([radiance](const EscapedRay&) { return radiance; });
}

inline Seen see(const Scene& scene, const Ray& ray, const ShadingOptions& options = {}) {
  Seen seen;
  shade(scene, options, {&ray, 1}, {&seen, 1});
  return seen;
}

constexpr double pi = 3.141592653589793;
inline double radians(double degrees) { return degrees * pi / 180; }
/// A ray from above that reaches the origin at this angle from the vertical, in the plane z = 0, toward +x.
inline Ray slanting(double degrees, double distance = 2) {
  Ray ray;
  ray.direction = {std::sin(radians(degrees)), -std::cos(radians(degrees)), 0};
  ray.origin = -distance * ray.direction;
  return ray;
}
/// Fresnel's reflectances of the two polarizations by another form than the product's: Fresnel's sine and tangent laws.
struct Reflectances {
  double parallel, perpendicular;
};
inline Reflectances fresnel_laws(double incidence, double ratio) {
  if (incidence == 0)
    return {(1 - ratio) * (1 - ratio) / ((1 + ratio) * (1 + ratio)), (1 - ratio) * (1 - ratio) / ((1 + ratio) * (1 + ratio))};
  const double bent = std::asin(std::sin(incidence) / ratio);
  const double s = std::sin(incidence - bent) / std::sin(incidence + bent), t = std::tan(incidence - bent) / std::tan(incidence + bent);
  return {t * t, s * s};
}
inline double fresnel(double incidence, double ratio) {
  const Reflectances r = fresnel_laws(incidence, ratio);
  return (r.parallel + r.perpendicular) / 2;
}

}  // namespace rainref::compositor::testing
