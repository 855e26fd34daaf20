// The rearranged evaluation of a pass: every result of a compiler that changes sums and products by the rules of real arithmetic.
//
// A number is a polynomial over leaves: loads, uniforms, literals and results of functions. It holds the exact range of the formula as
// written, and the quantities that bound the error of every rearrangement: the sum of the magnitudes of its terms, their number and their
// degree. Covered are commutativity, associativity, a (b + c) for a b + a c and back, cancelling and merging of equal terms, folded
// literals, moved signs, contraction, x (1 / c) for x / c, and operations moved through a select. Not covered: terms that are added and
// subtracted again, factors that the formula does not have, identities of functions. Profile::rearrangement says how far products of sums
// are multiplied out.
//
// With t terms of degree at most d, unit roundoff u and M the sum of the magnitudes, a result lies within
//   gamma M + 2 (t + d) 2^-126 H   of the exact value, gamma = k u / (1 - k u), k = t + d - 1,
// because a term passes at most t - 1 additions and d - 1 multiplications, and one more literal may be rounded elsewhere. H is M with
// leaves below 1 counted as 1, because a flushed factor is multiplied by the rest. Higham, Accuracy and Stability of Numerical Algorithms,
// 3.1, derives gamma. If all terms are multiples of one power of two and M is at most 2^24 times it, nothing rounds.
#pragma once

#include "math/enclosure.h"

namespace rainref::enclosed {

class Rearranged {
 public:
  using Mask = bool;
  using Int = scalar::Index<Rearranged>;
  static constexpr int size() { return 1; }

  Rearranged() : Rearranged(Enclosure(0.0f)) {}
  /// A literal or a uniform.
  Rearranged(float x) : Rearranged(Enclosure(x)) {}
  /// A leaf: the algebra treats its value as unknown.
  explicit Rearranged(const Enclosure& leaf);
  static Rearranged vacuous() { return Rearranged(Enclosure::vacuous()); }

  bool is_vacuous() const { return !(size_ < __builtin_inf()); }
  /// Interval of every result of every rearrangement.
  Enclosure settled() const;

  template <class Storage>
  static Rearranged load(const Storage* p) {
    return Rearranged(Enclosure::load(p));
  }
  static Rearranged index(int first) { return Rearranged(Enclosure::index(first)); }
  static Int uniform_int(int value) { return {value}; }

  friend Rearranged operator+(const Rearranged& a, const Rearranged& b);
  friend Rearranged operator-(Rearranged a);
  friend Rearranged operator-(const Rearranged& a, const Rearranged& b) { return a + -b; }
  friend Rearranged operator*(const Rearranged& a, const Rearranged& b);
  /// Like a (1 / b).
  friend Rearranged operator/(const Rearranged& a, const Rearranged& b);
  friend Rearranged square(const Rearranged& a);
  /// By either published formula.
  friend Rearranged mix(const Rearranged& a, const Rearranged& b, const Rearranged& t);

  friend bool operator<(const Rearranged& a, const Rearranged& b) { return a.settled() < b.settled(); }
  friend bool operator<=(const Rearranged& a, const Rearranged& b) { return a.settled() <= b.settled(); }
  friend bool operator>(const Rearranged& a, const Rearranged& b) { return b < a; }
  friend bool operator>=(const Rearranged& a, const Rearranged& b) { return b <= a; }
  /// Passed on, not made a leaf, because operations may move through a select.
  friend Rearranged select(bool m, const Rearranged& a, const Rearranged& b) { return m ? a : b; }
  friend Rearranged abs(const Rearranged& a);

  // Functions take every result of their argument, and return a leaf.
  friend Rearranged min(const Rearranged& a, const Rearranged& b) { return Rearranged(min(a.settled(), b.settled())); }
  friend Rearranged max(const Rearranged& a, const Rearranged& b) { return Rearranged(max(a.settled(), b.settled())); }
  friend Rearranged sqrt(const Rearranged& a) { return Rearranged(sqrt(a.not_below_zero())); }
  friend Rearranged inverse_sqrt(const Rearranged& a) { return Rearranged(inverse_sqrt(a.not_below_zero())); }
  friend Rearranged floor(const Rearranged& a) { return Rearranged(floor(a.settled())); }
  friend Rearranged fract(const Rearranged& a);
  friend Rearranged exp(const Rearranged& a) { return Rearranged(exp(a.settled())); }
  friend Rearranged exp2(const Rearranged& a) { return Rearranged(exp2(a.settled())); }
  friend Rearranged log(const Rearranged& a) { return Rearranged(log(a.settled())); }
  friend Rearranged log2(const Rearranged& a) { return Rearranged(log2(a.settled())); }
  friend Rearranged pow(const Rearranged& x, const Rearranged& y) { return Rearranged(pow(x.not_below_zero(), y.settled())); }
  friend Rearranged sin(const Rearranged& a) { return Rearranged(sin(a.settled())); }
  friend Rearranged cos(const Rearranged& a) { return Rearranged(cos(a.settled())); }
  friend Rearranged atan2(const Rearranged& y, const Rearranged& x) { return Rearranged(atan2(y.settled(), x.settled())); }

  friend Int to_int(const Rearranged& a) { return {to_int(a.settled()).i}; }
  friend Rearranged to_number(Int a) { return index(a.i); }
  friend Rearranged fetch(const float* texels, Int offset, const Rearranged&) { return Rearranged(Enclosure(texels[offset.i])); }

 private:
  /// Replaced by a leaf, if products of sums are not multiplied out.
  Rearranged as_leaf() const { return Rearranged(settled()); }
  Rearranged scaled(double power_of_two) const;
  bool is_power_of_two() const;
  /// settled(), without a negative part that comes only from the error bound.
  Enclosure not_below_zero() const;
  double error() const;
  /// True if every partial sum is a multiple of 2^q, at most 2^24 times it, and so a float: nothing rounds.
  bool is_on_grid() const;

  double lo_ = 0, hi_ = 0;  ///< the exact range of the formula as written
  double size_ = 0;         ///< sum of the magnitudes of the terms; infinite: vacuous
  double padded_ = 0;       ///< the same with every leaf counted as at least 1
  float terms_ = 0, degree_ = 0;
  int quantum_ = 0;  ///< all terms are multiples of 2^quantum_
  bool is_sum_ = false, is_leaf_ = true;
  bool is_factored_ = false;  ///< contains a product of sums that is not multiplied out
};

// Vocabulary functions, as for enclosures.
inline Rearranged sum_any_order(const Rearranged& a, const Rearranged& b, const Rearranged& c) { return a + b + c; }
inline Rearranged sum_any_order(const Rearranged& a, const Rearranged& b, const Rearranged& c, const Rearranged& d) {
  return a + b + c + d;
}
inline Rearranged sum_any_order_in_pairs(const Rearranged& a, const Rearranged& b, const Rearranged& c, const Rearranged& d) {
  return a + b + c + d;
}
inline Rearranged uniform_quotient(float a, float b, const Rearranged&) { return Rearranged(a) / Rearranged(b); }
/// t t (3 - 2 t) or 3 t t - 2 t t t.
Rearranged smoothstep(float edge0, float edge1, const Rearranged& x);
inline Rearranged nearest_octave(const Rearranged& x) { return Rearranged(nearest_octave(x.settled())); }
scalar::Vec3<Rearranged> normalize(const scalar::Vec3<Rearranged>& a);

}  // namespace rainref::enclosed
