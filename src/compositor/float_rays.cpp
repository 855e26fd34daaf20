// Rays that start far outside the scene, or with very long or short directions; kernels_float_rays.cpp handles the rest.
#include "compositor/float_rays.h"

#include <algorithm>

#include "compositor/extraordinary_ray.h"
#include "compositor/reals.h"

namespace rainref::compositor {

namespace {

/// The power of two that brings x into [1/2, 2); 0 < x <= 2^1000.
double scale_for(double x) {
  double scale = 1;
  while (x * scale >= 2) scale *= x * scale >= 0x1p64 ? 0x1p-64 : 0.5;
  while (x * scale < 0.5) scale *= x * scale < 0x1p-64 ? 0x1p64 : 2;
  return scale;
}

/// The entry of the ray into the box, at nearest or later; false if there is none.
bool entry_of(const Ray& ray, const Box& box, double& entry) {
  double from = ray.nearest, to = ray.farthest;
  for (int k = 0; k < 3; ++k) {
    if (ray.direction[k] == 0) {
      if (!(ray.origin[k] >= box.low[k] && ray.origin[k] <= box.high[k])) return false;
      continue;
    }
    const double a = (box.low[k] - ray.origin[k]) / ray.direction[k], b = (box.high[k] - ray.origin[k]) / ray.direction[k];
    from = most(from, least(a, b));
    to = least(to, most(a, b));
  }
  entry = from;
  return from <= to;
}

}  // namespace

void put_extraordinary_ray(const Ray& ray, const SceneExtent& extent, int slot, FloatPacket& out) {
  const Vec &o = ray.origin, &d = ray.direction;
  const double sum = magnitude(o.x) + magnitude(o.y) + magnitude(o.z) + magnitude(d.x) + magnitude(d.y) + magnitude(d.z);
  const double length = most(most(magnitude(d.x), magnitude(d.y)), magnitude(d.z));
  double start = 0;
  if (!(sum <= 0x1p1000 && length >= 0x1p-1000 && entry_of(ray, extent.box, start))) {
    out.enters &= ~(1u << slot);
    return;
  }
  if (!out.moved) {
    std::fill(out.start, out.start + Packet::slots, 0.0);
    std::fill(out.scale, out.scale + Packet::slots, 1.0);
    out.moved = true;
  }
  // origin + t d = origin at start + (t - start) / shrink * (shrink d), and both factors are powers of two.
  const double shrink = scale_for(length), scale = 1 / shrink, slack = extent.slack();
  const Vec origin = ray.at(start), direction = shrink * d;
  for (int k = 0; k < 3; ++k) {
    out.origin[k][slot] = static_cast<float>(origin[k]);
    out.direction[k][slot] = static_cast<float>(direction[k]);
  }
  out.start[slot] = start;
  out.scale[slot] = scale;
  out.nearest[slot] = static_cast<float>(least(most((ray.nearest - start) * scale * 0.9999 - slack, 0), largest_float));
  out.farthest[slot] = float_farthest((ray.farthest - start) * scale, slack);
}

}  // namespace rainref::compositor
