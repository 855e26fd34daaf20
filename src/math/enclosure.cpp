#include "math/enclosure.h"

#include <algorithm>
#include <cmath>

namespace rainref::enclosed {
namespace {

// Doubles from our own functions have a relative error below this.
constexpr double double_error = 0x1p-44;

double error_at(double y, const Accuracy& a, double x_magnitude) {
  const double size = y < 0 ? -y : y;
  return (a.ulp + a.ulp_per_x * x_magnitude) * ulp_of(y) + (a.relative + double_error) * size + a.absolute;
}

// The smallest possible result for an exact value in [low, high]. The error grows with |y|, and jumps at each power of two, so besides
// `low` the next power of two above it is tested.
double least(double low, double high, const Accuracy& a, double x_magnitude) {
  const double at_low = low - error_at(low, a, x_magnitude);
  if (low <= 0) return at_low;
  const double power = ulp_of(low) * 0x1p24;
  return power <= high ? std::min(at_low, power - error_at(power, a, x_magnitude)) : at_low;
}

// Minimum and maximum of four numbers, in registers.
double least_of(double a, double b, double c, double d) { return std::min(std::min(a, b), std::min(c, d)); }
double greatest_of(double a, double b, double c, double d) { return std::max(std::max(a, b), std::max(c, d)); }

Enclosure product(const Profile& p, double low, double high) {
  const bool nearest = p.basic == BasicRounding::nearest;
  Enclosure out = nearest ? Enclosure::checked(static_cast<float>(low), static_cast<float>(high))
                          : Enclosure::checked(float_below(low), float_above(high));
  if (p.contraction && !out.is_vacuous()) {
    out.is_product = true;
    out.product_lo = low;
    out.product_hi = high;
  }
  return out;
}

/// a + b rounded to the nearest float.
float nearest_sum(double a, double b) { return static_cast<float>(odd_sum(a, b)); }

}  // namespace

Enclosure widened(double low, double high, const Accuracy& accuracy, double x_magnitude) {
  double from = least(low, high, accuracy, x_magnitude), to = -least(-high, -low, accuracy, x_magnitude);
  if (accuracy.absolute == 0) {
    if (low >= 0) from = std::max(from, 0.0);
    if (high <= 0) to = std::min(to, 0.0);
  }
  return Enclosure::checked(float_below(from), float_above(to));
}

double Enclosure::width_in_ulp() const {
  const auto ordered = [](float x) {
    const auto bits = std::bit_cast<std::int32_t>(x + 0.0f);
    return static_cast<double>(bits < 0 ? -(bits & 0x7fffffff) : bits);
  };
  return ordered(hi) - ordered(lo);
}

Enclosure Enclosure::load_unorm(float x) {
  const Accuracy& a = profile().unorm_load;
  // The ends 0 and 1 are exact for every device.
  return profile().reference || a.is_zero() || x == 0 || x == 1 ? Enclosure(x) : widened(x, x, a, x);
}

Enclosure operator*(const Enclosure& a, const Enclosure& b) {
  if (a.is_vacuous() || b.is_vacuous()) return Enclosure::vacuous();
  const Profile& p = profile();
  if (p.reference && a.is_point() && b.is_point()) return Enclosure::checked(a.lo * b.lo, a.lo * b.lo);
  const double al = a.lo, ah = a.hi, bl = b.lo, bh = b.hi, ll = al * bl, lh = al * bh, hl = ah * bl, hh = ah * bh;
  return product(p, least_of(ll, lh, hl, hh), greatest_of(ll, lh, hl, hh));
}

Enclosure contracted_sum(const Enclosure& a, const Enclosure& b) {
  if (a.is_vacuous() || b.is_vacuous()) return Enclosure::vacuous();
  // At most one product is added unrounded.
  float low = a.lo + b.lo, high = a.hi + b.hi;
  if (a.is_product) {
    low = std::min(low, nearest_sum(a.product_lo, b.lo));
    high = std::max(high, nearest_sum(a.product_hi, b.hi));
  }
  if (b.is_product) {
    low = std::min(low, nearest_sum(b.product_lo, a.lo));
    high = std::max(high, nearest_sum(b.product_hi, a.hi));
  }
  return Enclosure::checked(low, high);
}

Enclosure square(const Enclosure& a) {
  const Enclosure m = abs(a);
  if (m.is_vacuous()) return m;
  return product(profile(), static_cast<double>(m.lo) * m.lo, static_cast<double>(m.hi) * m.hi);
}

Enclosure operator/(const Enclosure& a, const Enclosure& b) {
  const Profile& p = profile();
  if (p.reference && a.is_point() && b.is_point()) return Enclosure::checked(a.lo / b.lo, a.lo / b.lo);
  if (a.is_vacuous() || b.is_vacuous() || (b.lo <= 0 && 0 <= b.hi)) return Enclosure::vacuous();
  if (p.reference || p.division.is_zero()) {
    const float q[4] = {a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi};
    return Enclosure::checked(std::min(std::min(q[0], q[1]), std::min(q[2], q[3])), std::max(std::max(q[0], q[1]), std::max(q[2], q[3])));
  }
  // Accuracy is guaranteed only for divisors in [2^-126, 2^126] (Vulkan, WGSL, Metal).
  const double nearest = std::min(std::abs(b.lo), std::abs(b.hi)), furthest = std::max(std::abs(b.lo), std::abs(b.hi));
  if (nearest < 0x1p-126 || furthest > 0x1p126) return Enclosure::vacuous();
  const double al = a.lo, ah = a.hi, ll = al / b.lo, lh = al / b.hi, hl = ah / b.lo, hh = ah / b.hi;
  return widened(least_of(ll, lh, hl, hh), greatest_of(ll, lh, hl, hh), p.division, 0);
}

Enclosure inverse_sqrt(const Enclosure& a) {
  if (a.is_vacuous() || a.lo <= 0) return Enclosure::vacuous();
  const double low = 1 / __builtin_sqrt(static_cast<double>(a.hi)), high = 1 / __builtin_sqrt(static_cast<double>(a.lo));
  return widened(low, high, profile().inverse_sqrt, 0);
}

Enclosure sqrt(const Enclosure& a) {
  const Profile& p = profile();
  if (a.is_vacuous() || a.lo < 0) return Enclosure::vacuous();
  if (p.reference || (p.sqrt.is_zero() && !p.sqrt_is_inherited)) return Enclosure::checked(__builtin_sqrtf(a.lo), __builtin_sqrtf(a.hi));
  // The root of 0 is 0 by every formula: 1 / infinity.
  const Enclosure positive(a.lo > 0 ? a.lo : std::min(smallest_normal, a.hi), a.hi);
  if (a.hi == 0) return Enclosure(0.0f);
  Enclosure root;
  if (p.sqrt_is_inherited) {
    root = Enclosure(1.0f) / inverse_sqrt(positive);
  } else {
    root = widened(__builtin_sqrt(static_cast<double>(positive.lo)), __builtin_sqrt(static_cast<double>(positive.hi)), p.sqrt, 0);
  }
  if (root.is_vacuous()) return root;
  return {a.lo > 0 ? std::max(root.lo, 0.0f) : 0.0f, root.hi};
}

Enclosure floor(const Enclosure& a) {
  if (a.is_vacuous()) return a;
  const scalar::Scalar<float> low = floor(scalar::Scalar<float>(a.lo)), high = floor(scalar::Scalar<float>(a.hi));
  const double count = static_cast<double>(high.v) - low.v + 1;
  if (count == 1) return {low.v, low.v};
  if (count > PathEnumeration::max_runs) return {low.v, high.v};
  const float chosen = low.v + static_cast<float>(choose(static_cast<int>(count)));
  return {chosen, chosen};
}

Enclosure fract(const Enclosure& a) {
  const Enclosure cell = floor(a);
  if (profile().reference && a.is_point()) return a - cell;
  if (cell.is_vacuous()) return cell;
  if (!cell.is_point()) return {0.0f, 1.0f};
  // A product rounded up to the integer may be below it if it is fused.
  const Enclosure rest = outward_sum(a, -cell);
  return rest.is_vacuous() ? rest : Enclosure(a.is_product ? rest.lo : std::max(rest.lo, 0.0f), std::min(rest.hi, 1.0f));
}

Enclosure mix(const Enclosure& from, const Enclosure& to, const Enclosure& t) {
  const Enclosure one(1.0f);
  if (profile().reference || (from.is_point() && to.is_point() && t.is_point())) {
    const Enclosure published = from * (one - t) + to * t;
    return profile().reference ? published : hull(published, from + (to - from) * t);
  }
  if (from.is_vacuous() || to.is_vacuous() || t.is_vacuous()) return Enclosure::vacuous();
  // from * 1 + 0 and from + 0 are exact.
  if (t.lo == 0 && t.hi == 0) return Enclosure::checked(from.lo, from.hi);
  const Enclosure a = from.unrounded(), b = to.unrounded();
  // The exact function is linear in each argument, so its extrema are at corners. Then the roundings of either formula are added: (1 - t),
  // two products and a sum, or (b - a), a product and a sum, each relative to its operand.
  double low = 0x1p1000, high = -0x1p1000;
  const auto at = [&](double s) {
    // A rounded sum grows with each of its terms, so the corners of a and b need not be combined.
    const double from_a[2] = {a.lo * (1 - s), a.hi * (1 - s)}, from_b[2] = {b.lo * s, b.hi * s};
    low = std::min(low, std::min(from_a[0], from_a[1]) + std::min(from_b[0], from_b[1]));
    high = std::max(high, std::max(from_a[0], from_a[1]) + std::max(from_b[0], from_b[1]));
  };
  at(t.lo);
  at(t.hi);
  const double unit = profile().basic == BasicRounding::nearest ? 0x1p-24 : 0x1p-23;
  const double gap = std::max(std::abs(static_cast<double>(b.hi) - a.lo), std::abs(static_cast<double>(b.lo) - a.hi));
  const double rest = std::max(std::abs(1.0 - t.lo), std::abs(1.0 - t.hi));
  const double terms = std::max(2 * a.magnitude() * rest + b.magnitude() * t.magnitude(), 2 * gap * t.magnitude());
  const double flushed = profile().flush == Flush::never ? 0x1p-147 : 0x1p-124;
  const double error = unit * (terms + std::max(std::abs(low), std::abs(high))) * (1 + 0x1p-20) + flushed;
  Enclosure out(float_below(low - error), float_above(high + error));
  // Between values of one sign both formulas keep that sign, because rounding does.
  if (0 <= t.lo && t.hi <= 1) {
    if (a.lo >= 0 && b.lo >= 0) out.lo = std::max(out.lo, 0.0f);
    if (a.hi <= 0 && b.hi <= 0) out.hi = std::min(out.hi, 0.0f);
  }
  return Enclosure::checked(out.lo, out.hi);
}

}  // namespace rainref::enclosed
