#include "compositor/pane.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "compositor/reals.h"
#include "math/real64.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

Vec unit(const Vec& a) { return a / root(dot(a, a)); }
void take(Box& box, const Vec& p) {
  box.low = {least(box.low.x, p.x), least(box.low.y, p.y), least(box.low.z, p.z)};
  box.high = {most(box.high.x, p.x), most(box.high.y, p.y), most(box.high.z, p.z)};
}

}  // namespace

Pane::Pane(const PaneShape& shape) : shape_(shape) {
  const double uu = dot(shape.e_u, shape.e_u), uv = dot(shape.e_u, shape.e_v), vv = dot(shape.e_v, shape.e_v);
  const double area_sq = uu * vv - uv * uv;
  if (!(area_sq > 1e-12 * uu * vv)) throw Error(ExitCode::usage, "pane: expected corners that span a plane, found three on a line");
  normal_ = unit(cross(shape.e_u, shape.e_v));
  const double side = dot(normal_, shape.outside);
  if (!(std::abs(side) > 0)) throw Error(ExitCode::usage, "pane: expected a direction out of the pane, found one in its plane");
  if (side < 0) normal_ = -normal_;
  if (!(shape.thickness > 0)) throw Error(ExitCode::usage, fmt::format("pane: expected a thickness above 0 m, found {}", shape.thickness));
  dual_u_ = (vv / area_sq) * shape.e_u - (uv / area_sq) * shape.e_v;
  dual_v_ = (uu / area_sq) * shape.e_v - (uv / area_sq) * shape.e_u;
  if (is_flat()) return;

  const double chord = root(uu);
  if (!(std::abs(uv) <= 1e-9 * chord * root(vv)))
    throw Error(ExitCode::usage, "pane: expected perpendicular edges of a bent pane, found sheared ones");
  if (!(shape.radius >= 0.5 * chord && shape.radius > shape.thickness && shape.radius < 1e9)) {
    throw Error(ExitCode::usage,
                fmt::format("pane: expected a radius of at least half the chord ({} m) and above the thickness, found {} m", 0.5 * chord,
                            shape.radius));
  }
  across_ = shape.e_u / chord;
  length_ = root(vv);
  along_ = shape.e_v / length_;
  const double depth = root(shape.radius * shape.radius - 0.25 * uu);  // of the chord from the axis
  half_angle_ = atan2_real(Real64(0.5 * chord), Real64(depth)).v;
  axis_ = shape.corner + 0.5 * shape.e_u - depth * normal_;
}

Vec Pane::normal(double u) const {
  if (is_flat()) return normal_;
  const Real64 a((2 * u - 1) * half_angle_);
  return sin_real(a).v * across_ + cos_real(a).v * normal_;
}

Vec Pane::point(double u, double v, double lift) const {
  if (is_flat()) return shape_.corner + u * shape_.e_u + v * shape_.e_v + lift * normal_;
  return axis_ + (shape_.radius + lift) * normal(u) + v * shape_.e_v;
}

Vec Pane::tilted(double u, double rise_u, double rise_v) const {
  if (is_flat()) return unit(normal_ - rise_u * dual_u_ - rise_v * dual_v_);
  const Vec n = normal(u);
  const Vec tangent = cross(along_, n);  // unit, along the arc; the sign is set below
  const double sense = dot(tangent, across_) < 0 ? -1 : 1;
  return unit(n - (sense * rise_u / (2 * half_angle_ * shape_.radius)) * tangent - (rise_v / length_) * along_);
}

PaneCoordinates Pane::coordinates(const Vec& p) const {
  if (is_flat()) {
    const Vec from = p - shape_.corner;
    return {dot(from, dual_u_), dot(from, dual_v_), dot(from, normal_)};
  }
  const Vec from = p - axis_;
  const double x = dot(from, across_), y = dot(from, normal_);
  const double angle = atan2_real(Real64(x), Real64(y)).v;
  return {0.5 + 0.5 * angle / half_angle_, dot(from, along_) / length_, root(x * x + y * y) - shape_.radius};
}

int Pane::crossings(const Ray& ray, double lift, PanePoint (&points)[2]) const {
  if (is_flat()) {
    const Vec from = ray.origin - shape_.corner;
    const double toward = dot(ray.direction, normal_);
    if (toward == 0) return 0;
    const double t = (lift - dot(from, normal_)) / toward;
    const PaneCoordinates p = coordinates(ray.at(t));
    points[0] = {t, p.u, p.v};
    return 1;
  }
  const double r = shape_.radius + lift;
  const Vec from = ray.origin - axis_;
  const double ox = dot(from, across_), oy = dot(from, normal_), dx = dot(ray.direction, across_), dy = dot(ray.direction, normal_);
  const double a = dx * dx + dy * dy, b = ox * dx + oy * dy, c = ox * ox + oy * oy - r * r;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0 && a > 0)) return 0;
  // One root from terms of equal sign, the other from the product of the roots, which avoids cancellation.
  const double q = b < 0 ? root(discriminant) - b : -root(discriminant) - b;
  const double t0 = q / a, t1 = q == 0 ? t0 : c / q;
  int count = 0;
  for (const double t : {least(t0, t1), most(t0, t1)}) {
    const PaneCoordinates p = coordinates(ray.at(t));
    points[count++] = {t, p.u, p.v};
  }
  return count;
}

Box Pane::bounds(double low, double high) const {
  Box box{point(0, 0, low), point(0, 0, low)};
  for (const double lift : {low, high}) {
    for (const double u : {0.0, 0.5, 1.0}) {
      for (const double v : {0.0, 1.0}) take(box, point(u, v, lift));
    }
  }
  if (is_flat()) return box;
  // The arc lies within its chord's box enlarged by the sagitta, which is below half the chord.
  const double sagitta = shape_.radius + high - dot(point(0, 0, low) - axis_, normal_);
  box.low -= Vec(sagitta);
  box.high += Vec(sagitta);
  return box;
}

void PaneFace::meet(std::uint32_t self, std::uint32_t, const Ray& ray, Hit& first) const {
  PanePoint points[2];
  const int count = pane_.crossings(ray, lift_, points);
  for (int i = 0; i < count; ++i) {
    const PanePoint& p = points[i];
    if (!(p.t >= ray.nearest && p.t <= ray.farthest && p.u >= 0 && p.u <= 1 && p.v >= 0 && p.v <= 1) || !is_there(p.u, p.v)) continue;
    const Hit hit{p.t, self, 0, p.u, p.v};
    if (precedes(hit, first)) first = hit;
  }
}

Vec PaneRim::wall_normal(std::uint32_t part) const {
  const double u = part == 0 ? 0.0 : part == 1 ? 1.0 : 0.5;
  const Vec n = pane_.normal(u);
  const PaneShape& shape = pane_.shape();
  // Outward: away from the pane's centre.
  const Vec wall = part < 2 ? cross(n, shape.e_v) : pane_.is_flat() ? cross(n, shape.e_u) : shape.e_v;
  const Vec away = part < 2 ? (part == 0 ? -shape.e_u : shape.e_u) : (part == 2 ? -shape.e_v : shape.e_v);
  return unit(dot(wall, away) < 0 ? -wall : wall);
}

Box PaneRim::bounds(std::uint32_t) const { return pane_.bounds(-pane_.shape().thickness, height_); }

void PaneRim::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  const Vec n = wall_normal(primitive);
  const double u = primitive == 1 ? 1.0 : 0.0, v = primitive == 3 ? 1.0 : 0.0;
  const double toward = dot(ray.direction, n);
  if (toward == 0) return;
  const double t = dot(pane_.point(u, v) - ray.origin, n) / toward;
  if (!(t >= ray.nearest && t <= ray.farthest)) return;
  const PaneCoordinates p = pane_.coordinates(ray.at(t));
  const double place = primitive < 2 ? p.v : p.u;
  if (!(p.lift >= -pane_.shape().thickness && p.lift <= height_ && place >= 0 && place <= 1)) return;
  const Hit hit{t, self, primitive, place, p.lift};
  if (precedes(hit, first)) first = hit;
}

Vec PaneRim::normal(const Ray&, const Hit& hit) const { return wall_normal(hit.part); }

}  // namespace rainref::compositor
