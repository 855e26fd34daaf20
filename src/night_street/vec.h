// Small vectors and a few scalar functions of the street. Only + - * / sqrt and comparisons, so the bits are portable.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "math/smooth_step.h"
#include "scene/camera.h"

namespace rainref::night_street {

/// A point or direction in metres, or a linear RGB colour (x, y, z = red, green, blue).
using Vec = glm::dvec3;

/// a / |a|; a must not be zero.
inline Vec unit(const Vec& a) { return (1 / length(a)) * a; }
inline Vec mix(const Vec& a, const Vec& b, double t) { return a + t * (b - a); }
inline Vec from(const scene::Vector3& a) { return a; }
inline double luminance(const Vec& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

inline double mix(double a, double b, double t) { return a + t * (b - a); }
inline double min_of(double a, double b) { return b < a ? b : a; }
inline double max_of(double a, double b) { return a < b ? b : a; }
inline double magnitude(double a) { return a < 0 ? -a : a; }
inline double square(double a) { return a * a; }
inline double clamp01(double a) { return a < 0 ? 0 : a > 1 ? 1 : a; }
/// 0 below `from`, 1 above `to`, the cubic 3t^2 - 2t^3 between; from < to.
inline double smooth_step(double from, double to, double a) { return rainref::smooth_step((a - from) / (to - from)); }
/// 1 inside [low, high], 0 outside, with soft edges `edge` wide on the inner side.
inline double soft_band(double low, double high, double edge, double a) {
  return smooth_step(low, low + edge, a) * (1 - smooth_step(high - edge, high, a));
}
/// The largest integer <= a, for |a| < 2^62.
inline std::int64_t floor_int(double a) {
  const auto i = static_cast<std::int64_t>(a);
  return static_cast<double>(i) > a ? i - 1 : i;
}
inline double fraction(double a) { return a - static_cast<double>(floor_int(a)); }

/// A ray with unit direction. Reciprocals of components near zero are finite, so that slab tests never make a NaN.
struct Ray {
  Vec origin, direction, reciprocal;
  Ray(const Vec& from, const Vec& towards)
      : origin(from), direction(towards), reciprocal{inverse(towards.x), inverse(towards.y), inverse(towards.z)} {}
  Vec at(double t) const { return origin + t * direction; }

 private:
  static double inverse(double d) { return magnitude(d) < 1e-12 ? (d < 0 ? -1e12 : 1e12) : 1 / d; }
};

}  // namespace rainref::night_street
