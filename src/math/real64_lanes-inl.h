// The SIMD evaluation of double arithmetic, and the transcendental functions of a vector of floats.
//
// No operation crosses lanes, so the bits of an element do not depend on the width of the vector. hn::MulAdd, hn::Min/Max, hn::Floor/Round,
// estimates and sums over lanes are not used, because they differ between targets.
// Re-included for every target; see foreach_target.h.
#if defined(RAINREF_MATH_REAL64_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_MATH_REAL64_LANES_INL_H_
#undef RAINREF_MATH_REAL64_LANES_INL_H_
#else
#define RAINREF_MATH_REAL64_LANES_INL_H_
#endif

#include "hwy/highway.h"
#include "math/real64.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a / b. Highway's emulated vectors return 0 if b is 0.
template <class D>
HWY_INLINE HWY_ATTR hn::Vec<D> quotient(D d, hn::Vec<D> a, hn::Vec<D> b) {
#if HWY_TARGET == HWY_EMU128
  HWY_ALIGN hn::TFromD<D> x[hn::MaxLanes(D())], y[hn::MaxLanes(D())];
  hn::Store(a, d, x);
  hn::Store(b, d, y);
  for (std::size_t i = 0; i < hn::MaxLanes(d); ++i) x[i] /= y[i];
  return hn::Load(d, x);
#else
  static_cast<void>(d);
  return hn::Div(a, b);
#endif
}

/// A vector of doubles with the interface of Real64.
///
/// Its functions name the target (HWY_ATTR) because GCC does not give the target of the region to functions defined in a class. This only
/// matters without optimisation, when they are called instead of inlined: the caller then passes registers that the callee does not know.
struct Real64Lanes {
  using D = hn::ScalableTag<double>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using VU = hn::Vec<DU>;
  struct Mask {
    hn::Mask<D> m;
  };

  V v;

  HWY_INLINE HWY_ATTR Real64Lanes(V x) : v(x) {}
  HWY_INLINE HWY_ATTR Real64Lanes(double x) : v(hn::Set(D(), x)) {}

  friend HWY_INLINE HWY_ATTR Real64Lanes operator+(Real64Lanes a, Real64Lanes b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Real64Lanes operator-(Real64Lanes a, Real64Lanes b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Real64Lanes operator*(Real64Lanes a, Real64Lanes b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Real64Lanes operator/(Real64Lanes a, Real64Lanes b) { return quotient(D(), a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Real64Lanes operator-(Real64Lanes a) { return hn::Neg(a.v); }
  friend HWY_INLINE HWY_ATTR Mask operator<(Real64Lanes a, Real64Lanes b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator<=(Real64Lanes a, Real64Lanes b) { return {hn::Le(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator>(Real64Lanes a, Real64Lanes b) { return {hn::Gt(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator>=(Real64Lanes a, Real64Lanes b) { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Real64Lanes select(Mask m, Real64Lanes a, Real64Lanes b) { return hn::IfThenElse(m.m, a.v, b.v); }
  static HWY_INLINE HWY_ATTR bool any(Mask m) { return !hn::AllFalse(D(), m.m); }

  friend HWY_INLINE HWY_ATTR Real64Lanes abs(Real64Lanes a) { return hn::Abs(a.v); }
  friend HWY_INLINE HWY_ATTR Mask has_sign_bit(Real64Lanes a) { return from_lowest_bit(hn::ShiftRight<63>(a.bits())); }
  friend HWY_INLINE HWY_ATTR Real64Lanes flip_sign(Real64Lanes a, Real64Lanes s) {
    return hn::Xor(a.v, from_bits(hn::And(s.bits(), hn::Set(DU(), Real64::sign_bit))));
  }

  friend HWY_INLINE HWY_ATTR Mask is_odd(Real64Lanes biased) {
    return from_lowest_bit(hn::And(biased.bits(), hn::Set(DU(), std::uint64_t{1})));
  }
  friend HWY_INLINE HWY_ATTR Real64Lanes flip_sign_in_half_turn(Real64Lanes a, Real64Lanes biased) {
    return hn::Xor(a.v, from_bits(hn::ShiftLeft<62>(hn::And(biased.bits(), hn::Set(DU(), std::uint64_t{2})))));
  }
  friend HWY_INLINE HWY_ATTR Real64Lanes scale_by_power_of_two(Real64Lanes a, Real64Lanes biased) {
    return from_bits(hn::Add(a.bits(), hn::ShiftLeft<52>(biased.bits())));
  }
  friend HWY_INLINE HWY_ATTR Real64Lanes binary_exponent(Real64Lanes a) {
    const VU field = hn::ShiftRight<52>(hn::Add(a.bits(), hn::Set(DU(), Real64::exponent_offset)));
    return Real64Lanes(from_bits(hn::Or(field, hn::Set(DU(), Real64::two_to_52)))) - (0x1p52 + 1024);
  }

  friend HWY_INLINE HWY_ATTR void reduce_large_angles(Real64Lanes x, Real64Lanes& turns, Real64Lanes& rest) {
    const D d;
    HWY_ALIGN double angles[HWY_MAX_BYTES / sizeof(double)];
    HWY_ALIGN double all_turns[HWY_MAX_BYTES / sizeof(double)];
    HWY_ALIGN double all_rests[HWY_MAX_BYTES / sizeof(double)];
    hn::Store(x.v, d, angles);
    hn::Store(turns.v, d, all_turns);
    hn::Store(rest.v, d, all_rests);
    rainref::reduce_large_angles(angles, all_turns, all_rests, hn::MaxLanes(d));
    turns = hn::Load(d, all_turns);
    rest = hn::Load(d, all_rests);
  }

 private:
  HWY_INLINE HWY_ATTR VU bits() const { return hn::BitCast(DU(), v); }
  static HWY_INLINE HWY_ATTR V from_bits(VU bits) { return hn::BitCast(D(), bits); }
  /// The mask of lanes that hold 1; all others hold 0.
  static HWY_INLINE HWY_ATTR Mask from_lowest_bit(VU bit) { return {hn::MaskFromVec(from_bits(hn::Sub(hn::Zero(DU()), bit)))}; }
};

/// Several vectors of doubles with interleaved operations: the halves of a vector of floats, or pairs of pairs for several of those. A
/// formula is one long chain of dependent operations; chains side by side keep the processor busy.
template <class A, class B = A>
struct Real64Pair {
  struct Mask {
    typename A::Mask lower;
    typename B::Mask upper;
  };
  A lower;
  B upper;

  HWY_INLINE HWY_ATTR Real64Pair(A low, B high) : lower(low), upper(high) {}
  HWY_INLINE HWY_ATTR Real64Pair(double x) : lower(x), upper(x) {}

#define RAINREF_PAIRWISE(result, op)                                                        \
  friend HWY_INLINE HWY_ATTR result operator op(const Real64Pair& a, const Real64Pair& b) { \
    return {a.lower op b.lower, a.upper op b.upper};                                        \
  }
  RAINREF_PAIRWISE(Real64Pair, +)
  RAINREF_PAIRWISE(Real64Pair, -)
  RAINREF_PAIRWISE(Real64Pair, *)
  RAINREF_PAIRWISE(Real64Pair, /)
  RAINREF_PAIRWISE(Mask, <)
  RAINREF_PAIRWISE(Mask, <=)
  RAINREF_PAIRWISE(Mask, >)
  RAINREF_PAIRWISE(Mask, >=)
#undef RAINREF_PAIRWISE
#define RAINREF_PAIRWISE(function)                                                           \
  friend HWY_INLINE HWY_ATTR Real64Pair function(const Real64Pair& a, const Real64Pair& b) { \
    return {function(a.lower, b.lower), function(a.upper, b.upper)};                         \
  }
  RAINREF_PAIRWISE(flip_sign)
  RAINREF_PAIRWISE(flip_sign_in_half_turn)
  RAINREF_PAIRWISE(scale_by_power_of_two)
#undef RAINREF_PAIRWISE
  friend HWY_INLINE HWY_ATTR Real64Pair operator-(const Real64Pair& a) { return {-a.lower, -a.upper}; }
  friend HWY_INLINE HWY_ATTR Real64Pair select(const Mask& m, const Real64Pair& a, const Real64Pair& b) {
    return {select(m.lower, a.lower, b.lower), select(m.upper, a.upper, b.upper)};
  }
  static HWY_INLINE HWY_ATTR bool any(const Mask& m) { return A::any(m.lower) || B::any(m.upper); }
  friend HWY_INLINE HWY_ATTR Real64Pair abs(const Real64Pair& a) { return {abs(a.lower), abs(a.upper)}; }
  friend HWY_INLINE HWY_ATTR Real64Pair binary_exponent(const Real64Pair& a) {
    return {binary_exponent(a.lower), binary_exponent(a.upper)};
  }
  friend HWY_INLINE HWY_ATTR Mask has_sign_bit(const Real64Pair& a) { return {has_sign_bit(a.lower), has_sign_bit(a.upper)}; }
  friend HWY_INLINE HWY_ATTR Mask is_odd(const Real64Pair& a) { return {is_odd(a.lower), is_odd(a.upper)}; }
  friend HWY_INLINE HWY_ATTR void reduce_large_angles(const Real64Pair& x, Real64Pair& turns, Real64Pair& rest) {
    reduce_large_angles(x.lower, turns.lower, rest.lower);
    reduce_large_angles(x.upper, turns.upper, rest.upper);
  }
};

#pragma push_macro("RAINREF_FN")
#undef RAINREF_FN
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "math/transcendental-inl.h"
#pragma pop_macro("RAINREF_FN")

/// A vector of floats, and the part of it that widens to one vector of doubles.
using FloatTag = hn::ScalableTag<float>;
using FloatVector = hn::Vec<FloatTag>;
using NarrowTag = hn::Rebind<float, Real64Lanes::D>;

HWY_INLINE Real64Lanes widen(hn::Vec<NarrowTag> x) { return hn::PromoteTo(Real64Lanes::D(), x); }

/// The only rounding to float, like round_to_float(Real64).
HWY_INLINE hn::Vec<NarrowTag> round_to_float(Real64Lanes x) { return hn::DemoteTo(NarrowTag(), saturate_to_float(x).v); }

/// Conversion of a vector of floats to doubles, and back. The scalar target has one lane and no halves.
#if HWY_TARGET == HWY_SCALAR
using Real64Float = Real64Lanes;
HWY_INLINE Real64Float to_double(FloatVector x) { return widen(x); }
HWY_INLINE FloatVector to_float(Real64Float x) { return round_to_float(x); }
#else
using Real64Float = Real64Pair<Real64Lanes>;
HWY_INLINE Real64Float to_double(FloatVector x) {
  const NarrowTag half;
  return {widen(hn::LowerHalf(half, x)), widen(hn::UpperHalf(half, x))};
}
HWY_INLINE FloatVector to_float(Real64Float x) { return hn::Combine(FloatTag(), round_to_float(x.upper), round_to_float(x.lower)); }
#endif
using Real64Two = Real64Pair<Real64Float>;
using Real64Three = Real64Pair<Real64Two, Real64Float>;

/// The functions of transcendental-inl.h for a vector of floats; domain and accuracy are documented there. Not inlined: a pass calls
/// several of them, and a call is cheap compared with their work.
inline HWY_NOINLINE FloatVector exp_lanes(FloatVector x) { return to_float(exp_real(to_double(x))); }
inline HWY_NOINLINE FloatVector exp2_lanes(FloatVector x) { return to_float(exp2_real(to_double(x))); }
inline HWY_NOINLINE FloatVector log_lanes(FloatVector x) { return to_float(log_real(to_double(x))); }
inline HWY_NOINLINE FloatVector sin_lanes(FloatVector x) { return to_float(sin_real(to_double(x))); }
inline HWY_NOINLINE FloatVector cos_lanes(FloatVector x) { return to_float(cos_real(to_double(x))); }
inline HWY_NOINLINE FloatVector pow_lanes(FloatVector x, FloatVector y) { return to_float(pow_real(to_double(x), to_double(y))); }
inline HWY_NOINLINE FloatVector atan2_lanes(FloatVector y, FloatVector x) { return to_float(atan2_real(to_double(y), to_double(x))); }
/// The same for two or three vectors in place, interleaved.
inline HWY_NOINLINE void atan2_lanes(FloatVector (&y)[2], const FloatVector (&x)[2]) {
  const Real64Two z = atan2_real(Real64Two(to_double(y[0]), to_double(y[1])), Real64Two(to_double(x[0]), to_double(x[1])));
  y[0] = to_float(z.lower);
  y[1] = to_float(z.upper);
}
inline HWY_NOINLINE void pow_lanes(FloatVector (&x)[3], FloatVector y) {
  const Real64Float e = to_double(y);
  const Real64Three z = pow_real(Real64Three({to_double(x[0]), to_double(x[1])}, to_double(x[2])), Real64Three({e, e}, e));
  x[0] = to_float(z.lower.lower);
  x[1] = to_float(z.lower.upper);
  x[2] = to_float(z.upper);
}

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

#endif  // RAINREF_MATH_REAL64_LANES_INL_H_
