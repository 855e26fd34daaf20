#include "night_street/shapes.h"

namespace rainref::night_street {

namespace {

/// First crossing of a circle of this radius round the origin by (p, q) + t (dp, dq); false if it is missed or the start is inside.
bool enter_circle(double p, double q, double dp, double dq, double radius, double& t) {
  const double a = dp * dp + dq * dq, b = p * dp + q * dq, c = p * p + q * q - radius * radius;
  const double under = b * b - a * c;
  if (c <= 0 || b >= 0 || under <= 0) return false;
  t = (-b - std::sqrt(under)) / a;
  return true;
}

bool enter_sphere(const Solid& s, const Ray& ray, SolidHit& hit) {
  const Vec from_centre = ray.origin - s.a;
  const double b = dot(from_centre, ray.direction), c = dot(from_centre, from_centre) - square(s.b.x);
  const double under = b * b - c;
  if (c <= 0 || b >= 0 || under <= 0) return false;
  hit.t = -b - std::sqrt(under);
  hit.normal = unit(ray.at(hit.t) - s.a);
  return true;
}

bool enter_pole(const Solid& s, const Ray& ray, SolidHit& hit) {
  const Vec o = ray.origin - s.a;
  if (!enter_circle(o.x, o.z, ray.direction.x, ray.direction.z, s.b.x, hit.t)) return false;
  const double y = o.y + hit.t * ray.direction.y;
  if (y < 0 || y > s.b.y) return false;  // the ends are never seen: the foot is in the ground, the top under a head
  const Vec p = ray.at(hit.t) - s.a;
  hit.normal = unit({p.x, 0, p.z});
  return true;
}

bool enter_wheel(const Solid& s, const Ray& ray, SolidHit& hit) {
  const Vec o = ray.origin - s.a;
  // The flat side first, because it is the one that faces the street.
  const double side = o.x > 0 ? s.b.y : -s.b.y;
  const double t = (side - o.x) * ray.reciprocal.x;
  if (t > 0 && magnitude(o.x) > s.b.y) {
    const Vec p = o + t * ray.direction;
    if (p.y * p.y + p.z * p.z <= square(s.b.x)) {
      hit = {t, {o.x > 0 ? 1.0 : -1.0, 0, 0}};
      return true;
    }
  }
  if (!enter_circle(o.y, o.z, ray.direction.y, ray.direction.z, s.b.x, hit.t)) return false;
  const Vec p = o + hit.t * ray.direction;
  if (magnitude(p.x) > s.b.y) return false;
  hit.normal = unit({0, p.y, p.z});
  return true;
}

bool enter_convex(const Solid& s, const std::vector<Plane>& planes, const Ray& ray, SolidHit& hit) {
  double entry = -1e30, exit = 1e30;
  for (int i = s.first_plane; i < s.first_plane + s.plane_count; ++i) {
    const Plane& plane = planes[static_cast<std::size_t>(i)];
    const double towards = dot(plane.normal, ray.direction), gap = plane.offset - dot(plane.normal, ray.origin);
    if (towards == 0) {
      if (gap < 0) return false;
      continue;
    }
    const double t = gap / towards;
    if (towards < 0) {
      if (t > entry) {
        entry = t;
        hit.normal = plane.normal;
      }
    } else if (t < exit) {
      exit = t;
    }
  }
  hit.t = entry;
  return entry < exit && entry > 0;
}

}  // namespace

Vec entry_normal(const Box& box, const Ray& ray) {
  const double x = min_of((box.low.x - ray.origin.x) * ray.reciprocal.x, (box.high.x - ray.origin.x) * ray.reciprocal.x);
  const double y = min_of((box.low.y - ray.origin.y) * ray.reciprocal.y, (box.high.y - ray.origin.y) * ray.reciprocal.y);
  const double z = min_of((box.low.z - ray.origin.z) * ray.reciprocal.z, (box.high.z - ray.origin.z) * ray.reciprocal.z);
  if (x >= y && x >= z) return {ray.direction.x > 0 ? -1.0 : 1.0, 0, 0};
  if (y >= z) return {0, ray.direction.y > 0 ? -1.0 : 1.0, 0};
  return {0, 0, ray.direction.z > 0 ? -1.0 : 1.0};
}

Box Solid::bounds() const {
  switch (shape) {
    case sphere:
      return {a - Vec{b.x, b.x, b.x}, a + Vec{b.x, b.x, b.x}};
    case pole:
      return {a - Vec{b.x, 0, b.x}, a + Vec{b.x, b.y, b.x}};
    case wheel:
      return {a - Vec{b.y, b.x, b.x}, a + Vec{b.y, b.x, b.x}};
    case box:
    case convex:
      break;
  }
  return {a, b};
}

bool intersect(const Solid& solid, const std::vector<Plane>& planes, const Ray& ray, double nearest, double farthest, SolidHit& hit) {
  bool met = false;
  switch (solid.shape) {
    case Solid::sphere:
      met = enter_sphere(solid, ray, hit);
      break;
    case Solid::pole:
      met = enter_pole(solid, ray, hit);
      break;
    case Solid::wheel:
      met = enter_wheel(solid, ray, hit);
      break;
    case Solid::convex:
      met = enter_convex(solid, planes, ray, hit);
      break;
    case Solid::box: {
      const Box box{solid.a, solid.b};
      met = crosses(box, ray, farthest, hit.t) && hit.t > 0;
      if (met) hit.normal = entry_normal(box, ray);
      break;
    }
  }
  return met && hit.t > nearest && hit.t < farthest;
}

}  // namespace rainref::night_street
