#include "compositor/float_rays.h"

namespace rainref::compositor {

namespace {

double min_of(double a, double b) { return b < a ? b : a; }
double max_of(double a, double b) { return a < b ? b : a; }
double largest_of(const Vec& a) {
  const auto magnitude = [](double x) { return x < 0 ? -x : x; };
  return max_of(max_of(magnitude(a.x), magnitude(a.y)), magnitude(a.z));
}
constexpr double largest_float = 0x1.fffffep127;

/// The power of two that brings x > 0 into [1/2, 2).
double scale_for(double x) {
  double scale = 1;
  while (x * scale >= 2) scale *= x * scale >= 0x1p64 ? 0x1p-64 : 0.5;
  while (x * scale < 0.5) scale *= x * scale < 0x1p-64 ? 0x1p64 : 2;
  return scale;
}

/// Where the ray enters the box, at nearest or later; false when it does not.
bool entry_of(const Ray& ray, const Box& box, double& entry) {
  double from = ray.nearest, to = ray.farthest;
  for (int k = 0; k < 3; ++k) {
    if (ray.direction[k] == 0) {
      if (ray.origin[k] < box.low[k] || ray.origin[k] > box.high[k]) return false;
      continue;
    }
    const double a = (box.low[k] - ray.origin[k]) / ray.direction[k], b = (box.high[k] - ray.origin[k]) / ray.direction[k];
    from = max_of(from, min_of(a, b));
    to = min_of(to, max_of(a, b));
  }
  entry = from;
  return from <= to;
}

}  // namespace

float float_farthest(double t, double slack) { return static_cast<float>(min_of(t * 1.0001 + slack, largest_float)); }

FloatRay float_ray(const Ray& ray, const SceneExtent& extent) {
  FloatRay out{};
  Vec origin = ray.origin, direction = ray.direction;
  const double length = largest_of(direction);
  if (!(largest_of(origin) <= reach_of_largest * extent.largest && length >= 0.5 && length <= 1024)) {
    out.enters = length > 0 && length <= 0x1p1000 && entry_of(ray, extent.box, out.start);
    if (!out.enters) return out;
    out.scale = scale_for(length);
    origin = ray.at(out.start);
    direction *= out.scale;
  }
  const double slack = slack_of(extent);
  for (int k = 0; k < 3; ++k) {
    out.origin[k] = static_cast<float>(origin[k]);
    out.direction[k] = static_cast<float>(direction[k]);
  }
  out.nearest = static_cast<float>(min_of(max_of((ray.nearest - out.start) * out.scale * 0.9999 - slack, 0), largest_float));
  out.farthest = float_farthest((ray.farthest - out.start) * out.scale, slack);
  return out;
}

}  // namespace rainref::compositor
