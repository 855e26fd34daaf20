// Transcendental functions and named functions of enclosures: our own functions in double at the ends and at the extrema between them,
// widened by the profile's accuracy, then rounded outward.
#include <algorithm>
#include <cmath>

#include "math/constants.h"
#include "math/enclosure.h"
#include "math/floor_of.h"
#include "math/other_angles.h"

namespace rainref::enclosed {
namespace {

using Single = scalar::Scalar<float>;

Enclosure point(Single x) { return Enclosure::checked(x.v, x.v); }
// Whether the reference's result is exact here.
bool as_reference(const Enclosure& a) { return profile().reference && a.is_point(); }

Enclosure not_negative(const Enclosure& a) { return a.is_vacuous() ? a : Enclosure(std::max(a.lo, 0.0f), a.hi); }

Enclosure logarithm(const Enclosure& a, double scale, const Accuracy& far, const Accuracy& near_one) {
  if (a.is_vacuous() || a.lo <= 0) return Enclosure::vacuous();
  const double low = scale * log_real(Real64(a.lo)).v, high = scale * log_real(Real64(a.hi)).v;
  const bool reaches_far = a.lo < 0.5f || a.hi > 2.0f, reaches_near = a.hi >= 0.5f && a.lo <= 2.0f;
  if (!reaches_near) return widened(low, high, far, 0);
  const Enclosure near = widened(low, high, near_one, 0);
  return reaches_far ? hull(near, widened(low, high, far, 0)) : near;
}

// x > 0.
Enclosure positive_pow(const Enclosure& x, const Enclosure& y) {
  if (profile().pow_is_inherited) return exp2(y * log2(x));
  const auto at = [](float base, float exponent) { return pow_real(Real64(base), Real64(exponent)).v; };
  const auto [low, high] = std::minmax({at(x.lo, y.lo), at(x.lo, y.hi), at(x.hi, y.lo), at(x.hi, y.hi)});
  return not_negative(widened(low, high, profile().pow, 0));
}

// sin over [low, high] for phase 0, cos for phase pi / 2: f has its maximum at pi / 2 - phase + 2 pi n.
Enclosure wave(const Enclosure& a, double (*f)(double), double phase) {
  const Profile& p = profile();
  if (a.is_vacuous()) return a;
  const double size = a.magnitude();
  Accuracy accuracy = p.sin_cos;
  if (p.sin_cos_domain > 0 && size > p.sin_cos_domain) {
    if (p.sin_cos_beyond == 0) return Enclosure::vacuous();
    accuracy.absolute = std::max(accuracy.absolute, p.sin_cos_beyond * size);
  }
  double low = f(a.lo), high = f(a.hi);
  if (low > high) std::swap(low, high);
  if (!a.is_point()) {
    // For large angles the reduction of an interval is not worth the effort.
    const bool wide = size > 0x1p20;
    const auto has = [&](double place) {
      const double margin = 1e-6, turns = floor_of((a.hi + margin - place) / (2 * pi));
      return wide || place + turns * (2 * pi) >= a.lo - margin;
    };
    if (has(pi / 2 - phase)) high = 1;
    if (has(-pi / 2 - phase)) low = -1;
  }
  const Enclosure out = widened(low, high, accuracy, size);
  return {std::max(out.lo, -1.0f), std::min(out.hi, 1.0f)};
}

double octave_of(float x) { return nearest_octave(Single(x)).v; }

}  // namespace

Enclosure exp(const Enclosure& a) {
  if (as_reference(a)) return point(exp(Single(a.lo)));
  if (a.is_vacuous()) return a;
  return not_negative(widened(exp_real(Real64(a.lo)).v, exp_real(Real64(a.hi)).v, profile().exp, a.magnitude()));
}
Enclosure exp2(const Enclosure& a) {
  if (as_reference(a)) return point(exp2(Single(a.lo)));
  if (a.is_vacuous()) return a;
  return not_negative(widened(exp2_real(Real64(a.lo)).v, exp2_real(Real64(a.hi)).v, profile().exp2, a.magnitude()));
}
Enclosure log(const Enclosure& a) {
  if (as_reference(a)) return point(log(Single(a.lo)));
  return logarithm(a, 1, profile().log, profile().log_near_one);
}
Enclosure log2(const Enclosure& a) { return logarithm(a, coefficients::log2_e, profile().log2, profile().log2_near_one); }

Enclosure pow(const Enclosure& x, const Enclosure& y) {
  if (as_reference(x) && as_reference(y)) return point(pow(Single(x.lo), Single(y.lo)));
  if (x.is_vacuous() || y.is_vacuous() || x.lo < 0 || (x.lo == 0 && y.lo <= 0)) return Enclosure::vacuous();
  if (x.lo > 0) return positive_pow(x, y);
  // A positive power grows with x, from 0. If it is subnormal, the hundreds of ULP that exp2 may err there amount to 2^-139.
  if (x.hi == 0) return Enclosure(0.0f);
  const Enclosure top = positive_pow({x.hi, x.hi}, y);
  return top.is_vacuous() ? top : Enclosure(0.0f, std::max(top.hi, 0x1p-139f));
}

Enclosure sin(const Enclosure& a) {
  if (as_reference(a)) return point(sin(Single(a.lo)));
  return wave(
      a, [](double x) { return sin_real(Real64(x)).v; }, 0);
}
Enclosure cos(const Enclosure& a) {
  if (as_reference(a)) return point(cos(Single(a.lo)));
  return wave(
      a, [](double x) { return cos_real(Real64(x)).v; }, pi / 2);
}

namespace {

thread_local bool takes_other_angles = false;

Enclosure angle_as_named(const Enclosure& y, const Enclosure& x) {
  if (as_reference(y) && as_reference(x)) return point(atan2(Single(y.lo), Single(x.lo)));
  if (x.is_vacuous() || y.is_vacuous()) return Enclosure::vacuous();
  const Accuracy& accuracy = profile().atan2;
  // A box contains its corners, and if they have one sign, no point that is nearer to zero or larger.
  const auto has_sign = [](Enclosure e) { return e.lo > 0 || e.hi < 0; };
  if (profile().atan2_domain > 0 &&
      !(has_sign(y) && has_sign(x) && is_promised(profile(), y.lo, x.lo) && is_promised(profile(), y.hi, x.hi)))
    return Enclosure::vacuous();
  double y0 = y.lo, y1 = y.hi;
  if (x.lo <= 0 && y0 <= 0 && 0 <= y1) {
    if (x.hi >= 0) return widened(-pi, pi, accuracy, 0);  // around the origin
    // Some devices lose the sign of a zero, so +0 and -0 are both tried.
    if (choose(2) != 0)
      y0 = 0.0;
    else
      y1 = -0.0;
  }
  // Away from the origin and the cut, the extreme angles of a box are at its corners.
  const auto at = [](double height, double width) { return atan2_real(Real64(height), Real64(width)).v; };
  const auto [low, high] = std::minmax({at(y0, x.lo), at(y0, x.hi), at(y1, x.lo), at(y1, x.hi)});
  return widened(low, high, accuracy, 0);
}

/// asin and acos of s in [-1, 1]: Vulkan and WGSL derive them from atan2 of s and the root of 1 - s s. WGSL also allows an error of
/// 6.81e-5, the error of the polynomials in HLSL's compilers.
constexpr float arc_error = 6.81e-5f;
Enclosure about(double low, double high) { return {float_below(low - arc_error), float_above(high + arc_error)}; }
Enclosure other_side(Enclosure s) { return sqrt(max(Enclosure(1.0f) - square(s), Enclosure(0.0f))); }
Enclosure arcsine(Enclosure s) {
  const Enclosure c = other_side(s);
  return about(atan2_real(Real64(s.lo), Real64(s.lo < 0 ? c.lo : c.hi)).v, atan2_real(Real64(s.hi), Real64(s.hi < 0 ? c.hi : c.lo)).v);
}
Enclosure arccosine(Enclosure s) {
  const Enclosure c = other_side(s);
  return about(atan2_real(Real64(s.hi < 0 ? c.hi : c.lo), Real64(s.hi)).v, atan2_real(Real64(s.lo < 0 ? c.lo : c.hi), Real64(s.lo)).v);
}

/// The hull of `named` and the other formulas.
Enclosure with_other_angles(Enclosure named, const Enclosure& y, const Enclosure& x) {
  const auto held = [](Enclosure s) { return min(max(s.unrounded(), Enclosure(-1.0f)), Enclosure(1.0f)); };
  const Enclosure r = sqrt(square(x) + square(y)), cosine = held(x / r), sine = held(y / r);
  if (named.is_vacuous() || cosine.is_vacuous() || sine.is_vacuous()) return named;
  Enclosure out = named;
  const Enclosure turn = arccosine(cosine);
  if (y.hi >= 0) out = hull(out, turn);
  if (y.lo <= 0) out = hull(out, -turn);
  if (x.lo < 0) return out;
  out = hull(out, arcsine(sine));
  constexpr float nearly = 0x1p-16f;
  if (r.lo > 1 + nearly || r.hi < 1 - nearly) return out;
  const Enclosure from_pole = arccosine(held(y));
  return hull(hull(out, arcsine(held(y))), {float_below(pi / 2 - from_pole.hi), float_above(pi / 2 - from_pole.lo)});
}

}  // namespace

OtherAngles::OtherAngles() : before_(takes_other_angles) { takes_other_angles = true; }
OtherAngles::~OtherAngles() { takes_other_angles = before_; }

Enclosure atan2(const Enclosure& y, const Enclosure& x) {
  const Enclosure named = angle_as_named(y, x);
  return takes_other_angles && !profile().reference ? with_other_angles(named, y, x) : named;
}

Enclosure sum_any_order(const Enclosure& a, const Enclosure& b, const Enclosure& c) {
  if (profile().reference) return scalar::sum_any_order<Enclosure>(a, b, c);
  const auto add = [](Enclosure x, Enclosure y) { return outward_sum(x, y); };
  return hull(add(add(a, b), c), hull(add(add(a, c), b), add(add(b, c), a)));
}

namespace {

Enclosure sum_by_all_trees(const Enclosure& a, const Enclosure& b, const Enclosure& c, const Enclosure& d) {
  const auto add = [](Enclosure x, Enclosure y) { return outward_sum(x, y); };
  const Enclosure chains = hull(hull(add(sum_any_order(a, b, c), d), add(sum_any_order(a, b, d), c)),
                                hull(add(sum_any_order(a, c, d), b), add(sum_any_order(b, c, d), a)));
  return hull(chains, hull(add(add(a, b), add(c, d)), hull(add(add(a, c), add(b, d)), add(add(a, d), add(b, c)))));
}

}  // namespace

Enclosure sum_any_order(const Enclosure& a, const Enclosure& b, const Enclosure& c, const Enclosure& d) {
  return profile().reference ? scalar::sum_any_order<Enclosure>(a, b, c, d) : sum_by_all_trees(a, b, c, d);
}
Enclosure sum_any_order_in_pairs(const Enclosure& a, const Enclosure& b, const Enclosure& c, const Enclosure& d) {
  return profile().reference ? scalar::sum_any_order_in_pairs<Enclosure>(a, b, c, d) : sum_by_all_trees(a, b, c, d);
}

Enclosure smoothstep(float edge0, float edge1, const Enclosure& x) {
  if (profile().reference) return scalar::smoothstep<Enclosure>(edge0, edge1, x);
  const Enclosure t = scalar::saturate((x - Enclosure(edge0)) / (Enclosure(edge1) - Enclosure(edge0)));
  if (t.is_vacuous()) return t;
  if (t.is_point() && (t.lo == 0 || t.lo == 1)) return t;
  // The cubic grows with t; its three roundings are relative to it.
  const auto cubic = [](double s) { return s * s * (3 - 2 * s); };
  const double unit = profile().basic == BasicRounding::nearest ? 0x1p-24 : 0x1p-23;
  const Enclosure grown = not_negative(widened(cubic(t.lo), cubic(t.hi), {.relative = 3.001 * unit, .absolute = 0x1p-147}, 0));
  // As written, in either grouping; tighter if t is nearly a point and the roundings are few.
  const Enclosure slope = Enclosure(3.0f) - Enclosure(2.0f) * t, written = hull(t * t * slope, t * (t * slope));
  return {std::max(grown.lo, written.lo), std::min(grown.hi, written.hi)};
}

Enclosure nearest_octave(const Enclosure& x) {
  if (x.is_vacuous()) return {0.0f, 12.0f};
  const double low = octave_of(x.lo), high = octave_of(x.hi), count = high - low + 1;
  if (count > PathEnumeration::max_runs) return {static_cast<float>(low), static_cast<float>(high)};
  const double level = count == 1 ? low : low + choose(static_cast<int>(count));
  return {static_cast<float>(level), static_cast<float>(level)};
}

scalar::Vec3<Enclosure> normalize(const scalar::Vec3<Enclosure>& a) {
  const Profile& p = profile();
  if (p.reference) return scalar::normalize<Enclosure>(a);
  const Enclosure squared = sum_any_order(square(a.x), square(a.y), square(a.z));
  const Enclosure length = sqrt(squared), inverse = Enclosure(1.0f) / length, direct = inverse_sqrt(squared);
  // No component is larger than the whole, except for the errors of the formulas: two divisions, a root, a sum and products.
  const double slack = (10 + 2 * p.division.ulp + p.sqrt.ulp + 2 * p.inverse_sqrt.ulp) * 0x1p-23 + 2 * p.division.relative +
                       p.sqrt.relative + 2 * p.inverse_sqrt.relative;
  const float limit = float_above(1 + slack);
  const auto component = [&](Enclosure c) {
    const Enclosure any = hull(hull(inverse * c, c / length), c * direct);
    return any.is_vacuous() ? any : Enclosure(std::max(any.lo, -limit), std::min(any.hi, limit));
  };
  return {component(a.x), component(a.y), component(a.z)};
}

}  // namespace rainref::enclosed
