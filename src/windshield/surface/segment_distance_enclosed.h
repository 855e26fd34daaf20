// The distance to a segment as an enclosure, tighter than by the formula as written. An error in the position of the nearest point along
// the segment changes the distance only in second order, which intervals of the two components cannot know.
#pragma once

#include <algorithm>

#include "math/enclosure.h"

namespace rainref::windshield::scalar {

/// Bounds of |from x along| / |along|, in double: each factor is one number, so only the length is used twice.
struct Perpendicular {
  double low, high, length;
};
inline Perpendicular perpendicular(enclosed::Enclosure fx, enclosed::Enclosure fy, enclosed::Enclosure ax, enclosed::Enclosure ay) {
  const auto product = [](enclosed::Enclosure a, enclosed::Enclosure b) {
    const double al = a.lo, ah = a.hi;
    return std::minmax({al * b.lo, al * b.hi, ah * b.lo, ah * b.hi});
  };
  const auto larger = [](double a, double b) { return std::max(a < 0 ? -a : a, b < 0 ? -b : b); };
  const auto smaller = [&](enclosed::Enclosure a) { return a.lo > 0 ? a.lo : a.hi < 0 ? -a.hi : 0.0; };
  const auto [pl, ph] = product(fx, ay);
  const auto [ql, qh] = product(fy, ax);
  const double low = pl - qh, high = ph - ql, most = larger(low, high), least = low > 0 ? low : high < 0 ? -high : 0;
  const double shortest = __builtin_sqrt(smaller(ax) * smaller(ax) + smaller(ay) * smaller(ay));
  const double longest = __builtin_sqrt(larger(ax.lo, ax.hi) * larger(ax.lo, ax.hi) + larger(ay.lo, ay.hi) * larger(ay.lo, ay.hi));
  constexpr double slack = 1e-14;  // rounding error of these doubles
  return {longest > 0 ? least / longest * (1 - slack) : 0, shortest > 0 ? most / shortest * (1 + slack) : 1e30, longest};
}

/// segment_distance of wipe_texture.pass.h. Between the ends, for a position t that is off by d from the nearest one:
///   distance^2 = perpendicular^2 + (d length)^2.
inline enclosed::Enclosure segment_distance(enclosed::Enclosure px, enclosed::Enclosure py, enclosed::Enclosure ax, enclosed::Enclosure ay,
                                            enclosed::Enclosure bx, enclosed::Enclosure by) {
  using enclosed::Enclosure;
  const Enclosure along_x = bx - ax, along_y = by - ay, from_x = px - ax, from_y = py - ay;
  const Enclosure length_sq = max(square(along_x) + square(along_y), Enclosure(1e-12f));
  const Enclosure t = rainref::scalar::saturate((from_x * along_x + from_y * along_y) / length_sq);
  const Enclosure written = rainref::scalar::length(from_x - t * along_x, from_y - t * along_y);
  const enclosed::Profile& p = enclosed::profile();
  if (p.reference || written.is_vacuous() || !(t.lo > 0 && t.hi < 1 && length_sq.lo > 1e-6f)) return written;

  const Perpendicular d = perpendicular(from_x.unrounded(), from_y.unrounded(), along_x.unrounded(), along_y.unrounded());
  // Two roundings of each component, then those of two squares and their sum.
  const double unit = p.basic == enclosed::BasicRounding::nearest ? 0x1p-24 : 0x1p-23,
               flushed = p.flush == enclosed::Flush::never ? 0 : 0x1p-124;
  const double x = unit * (t.hi * along_x.magnitude() + written.magnitude()), y = unit * (t.hi * along_y.magnitude() + written.magnitude());
  const double rounded = __builtin_sqrt(x * x + y * y) * (1 + 0x1p-20) + flushed,
               off = (static_cast<double>(t.hi) - t.lo + 0x1p-22) * d.length;
  const double low = std::max(d.low - rounded, 0.0) * (1 - 3 * unit),
               high = (__builtin_sqrt(d.high * d.high + off * off) + rounded) * (1 + 3 * unit);
  const Enclosure tight = sqrt(square(Enclosure(std::max(enclosed::float_below(low), 0.0f), enclosed::float_above(high))));
  return {std::max(written.lo, tight.lo), std::min(written.hi, tight.hi)};
}

}  // namespace rainref::windshield::scalar
