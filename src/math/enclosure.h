// The enclosure evaluation of a pass: a number is a closed interval that holds every result that a conforming GPU may produce.
//
// It offers the interface that ARCHITECTURE.md lists for a number. Profile says what is allowed (profile.h); PathEnumeration runs the
// alternatives that an interval leaves open (paths.h). If a profile allows either neighbour of a result, operations round outward, which
// also covers fusion. If it rounds to nearest, a product keeps its value before rounding, for an addition that fuses it. Exact results stay
// points. Under the profile `ieee` nothing is widened, and a point has the bits of Scalar<float>.
//
// A result that may be infinite, NaN or undefined is vacuous, the interval of everything, and so is every result computed from it.
#pragma once

#include <atomic>

#include "math/directed.h"
#include "math/scalar.h"
#include "math/path_enumeration.h"

namespace rainref::enclosed {

class Enclosure;
namespace detail {
/// Number of UncertainValues.
extern std::atomic<int> uncertain_arrays;
/// The interval of a value, if it belongs to one of them, or the value.
Enclosure loaded(const float* p);
}  // namespace detail

class Enclosure {
 public:
  using Mask = bool;
  using Int = scalar::Index<Enclosure>;
  static constexpr int size() { return 1; }

  float lo, hi;  ///< never NaN; lo <= hi
  /// For a product that may be fused into an addition: its exact range before rounding.
  bool is_product = false;
  double product_lo = 0, product_hi = 0;

  Enclosure() : lo(0), hi(0) {}
  /// A literal or a uniform. A subnormal may be treated as zero.
  Enclosure(float x) : lo(x), hi(x) { check(); }
  /// The interval unchanged; the caller ensures lo <= hi.
  Enclosure(float low, float high) : lo(low), hi(high) {}
  static Enclosure vacuous() { return {-infinity, infinity}; }

  bool is_vacuous() const { return lo == -infinity && hi == infinity; }
  bool is_point() const { return lo == hi; }
  bool contains(float x) const { return lo <= x && x <= hi; }
  /// The larger magnitude of the ends.
  double magnitude() const { return -lo < hi ? hi : -static_cast<double>(lo); }
  /// Number of floats from lo to hi, minus one: 0 for a point. Both zeros count as one float.
  double width_in_ulp() const;

  template <class Storage>
  static Enclosure load(const Storage* p) {
    if constexpr (std::is_same_v<Storage, Unorm8>)
      return load_unorm(scalar::to_float(*p));
    else if constexpr (std::is_same_v<Storage, float>)
      return detail::uncertain_arrays.load(std::memory_order_relaxed) == 0 ? Enclosure(*p) : detail::loaded(p);
    else
      return Enclosure(scalar::to_float(*p));
  }
  static Enclosure index(int first) { return {static_cast<float>(first), static_cast<float>(first)}; }
  static Int uniform_int(int value) { return {value}; }

  friend Enclosure operator+(const Enclosure& a, const Enclosure& b) {
    if (profile().basic != BasicRounding::nearest) return outward_sum(a, b);
    return a.is_product || b.is_product ? contracted_sum(a, b) : checked(a.lo + b.lo, a.hi + b.hi);
  }
  friend Enclosure operator-(const Enclosure& a) {
    Enclosure out(-a.hi, -a.lo);
    out.is_product = a.is_product;
    out.product_lo = -a.product_hi;
    out.product_hi = -a.product_lo;
    return out;
  }
  friend Enclosure operator-(const Enclosure& a, const Enclosure& b) { return a + -b; }
  friend Enclosure operator*(const Enclosure& a, const Enclosure& b);
  friend Enclosure operator/(const Enclosure& a, const Enclosure& b);
  /// The sum with every rounding and with none, whatever the profile's basic rounding.
  friend Enclosure outward_sum(const Enclosure& a, const Enclosure& b) {
    if (!a.is_product && !b.is_product) return checked(sum_below(a.lo, b.lo), sum_above(a.hi, b.hi));
    const Enclosure x = a.unrounded(), y = b.unrounded();
    return checked(sum_below(x.lo, y.lo), sum_above(x.hi, y.hi));
  }
  /// The number before and after its rounding.
  Enclosure unrounded() const { return is_product ? checked(float_below(product_lo), float_above(product_hi)) : *this; }

  // An exact tie of points needs no decision.
  friend bool operator<(const Enclosure& a, const Enclosure& b) { return a.hi < b.lo || (a.lo < b.hi && choose(2) != 0); }
  friend bool operator<=(const Enclosure& a, const Enclosure& b) { return a.hi <= b.lo || (a.lo <= b.hi && choose(2) != 0); }
  friend bool operator>(const Enclosure& a, const Enclosure& b) { return b < a; }
  friend bool operator>=(const Enclosure& a, const Enclosure& b) { return b <= a; }
  friend Enclosure select(bool m, const Enclosure& a, const Enclosure& b) { return m ? a : b; }
  friend Enclosure hull(const Enclosure& a, const Enclosure& b) {
    const Enclosure x = a.unrounded(), y = b.unrounded();
    return {x.lo < y.lo ? x.lo : y.lo, x.hi < y.hi ? y.hi : x.hi};
  }
  friend Enclosure min(const Enclosure& a, const Enclosure& b) {
    if (a.is_vacuous() || b.is_vacuous()) return vacuous();
    return {b.lo < a.lo ? b.lo : a.lo, b.hi < a.hi ? b.hi : a.hi};
  }
  friend Enclosure max(const Enclosure& a, const Enclosure& b) {
    if (a.is_vacuous() || b.is_vacuous()) return vacuous();
    return {a.lo < b.lo ? b.lo : a.lo, a.hi < b.hi ? b.hi : a.hi};
  }
  friend Enclosure abs(const Enclosure& a) {
    if (a.is_vacuous()) return a;
    if (a.lo >= 0) return a;
    if (a.hi <= 0) return -a;
    const Enclosure whole = a.unrounded();
    return {0.0f, -whole.lo < whole.hi ? whole.hi : -whole.lo};
  }
  friend Enclosure square(const Enclosure& a);
  friend Enclosure sqrt(const Enclosure& a);
  /// 1 / sqrt(a) as one GPU instruction. Passes do not use it; normalize and an inherited sqrt do.
  friend Enclosure inverse_sqrt(const Enclosure& a);

  /// If the integer is open: one of at most PathEnumeration::max_runs candidates, else the interval of all of them.
  friend Enclosure floor(const Enclosure& a);
  /// a - floor(a), with the candidate that floor takes; in [0, 1] except for a fused product. [0, 1] if there are too many candidates.
  friend Enclosure fract(const Enclosure& a);
  /// Gives up the invocation if a is not exactly one integer.
  friend Int to_int(const Enclosure& a) {
    if (a.is_point() && a.lo > -0x1p30f && a.lo < 0x1p30f) return {static_cast<std::int32_t>(a.lo)};
    give_up();
    return {0};
  }
  friend Enclosure to_number(Int a) { return index(a.i); }

  /// a (1 - t) + b t or a + (b - a) t: shading languages specify both.
  friend Enclosure mix(const Enclosure& a, const Enclosure& b, const Enclosure& t);

  friend Enclosure exp(const Enclosure& a);
  friend Enclosure exp2(const Enclosure& a);
  friend Enclosure log(const Enclosure& a);
  friend Enclosure log2(const Enclosure& a);
  /// Vacuous if x may be negative; 0 to a positive power is 0.
  friend Enclosure pow(const Enclosure& x, const Enclosure& y);
  friend Enclosure sin(const Enclosure& a);
  friend Enclosure cos(const Enclosure& a);
  /// If x is negative and y may have either sign, the sign is decided, because the function is discontinuous there.
  friend Enclosure atan2(const Enclosure& y, const Enclosure& x);

  friend Enclosure fetch(const float* texels, Int offset, Enclosure) { return Enclosure(texels[offset.i]); }

  /// The interval with its computed ends: vacuous if one is not finite, extended to zero if a flush allows that.
  static Enclosure checked(float low, float high) {
    Enclosure computed(low, high);
    computed.check();
    return computed;
  }

 private:
  void check() {
    const Profile& p = profile();
    if (p.reference ? !(lo == lo && hi == hi) : !(lo >= -largest_finite && hi <= largest_finite)) {
      lo = -infinity;
      hi = infinity;
    } else if (!p.reference && p.flush != Flush::never) {
      // Includes the smallest normal itself, because an implementation may check before it rounds.
      if (0 < lo && lo <= smallest_normal) lo = 0;
      if (-smallest_normal <= hi && hi < 0) hi = 0;
    }
  }
  friend Enclosure contracted_sum(const Enclosure& a, const Enclosure& b);
  static Enclosure load_unorm(float x);
};

// Vocabulary functions for which intervals have tighter versions than the general formulas. Argument-dependent lookup finds them before the
// templates.

/// In every order of the additions.
Enclosure sum_any_order(const Enclosure& a, const Enclosure& b, const Enclosure& c);
Enclosure sum_any_order(const Enclosure& a, const Enclosure& b, const Enclosure& c, const Enclosure& d);
Enclosure sum_any_order_in_pairs(const Enclosure& a, const Enclosure& b, const Enclosure& c, const Enclosure& d);
inline Enclosure uniform_quotient(float a, float b, Enclosure) { return Enclosure(a) / Enclosure(b); }
/// t t (3 - 2 t), as the specifications write it, or regrouped: (t t) (3 - 2 t) or t (t (3 - 2 t)).
Enclosure smoothstep(float edge0, float edge1, const Enclosure& x);
/// One decision instead of one for each octave.
Enclosure nearest_octave(const Enclosure& x);
/// (1 / length(a)) a, a / length(a) or a inversesqrt(dot(a, a)).
scalar::Vec3<Enclosure> normalize(const scalar::Vec3<Enclosure>& a);

/// The smallest interval of floats that holds the reals [low, high].
inline Enclosure rounded_outward(double low, double high) { return {float_below(low), float_above(high)}; }
inline double width_of(const Enclosure& a) { return static_cast<double>(a.hi) - a.lo; }
/// The interval of reals [low, high] computed with that accuracy and rounded outward.
Enclosure widened(double low, double high, const Accuracy& accuracy, double x_magnitude);

}  // namespace rainref::enclosed
