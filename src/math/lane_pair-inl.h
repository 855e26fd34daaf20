// Two vectors of the reference evaluation, with their operations interleaved: the same bits as one after the other. A formula is a chain of
// dependent operations; for a long one, two chains side by side keep the processor busy. Re-included for every target, like lanes-inl.h.
#if defined(RAINREF_MATH_LANE_PAIR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_MATH_LANE_PAIR_INL_H_
#undef RAINREF_MATH_LANE_PAIR_INL_H_
#else
#define RAINREF_MATH_LANE_PAIR_INL_H_
#endif

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {

/// A number whose elements are those of a, then those of b. It has no fetch.
struct LanePair {
  struct Mask {
    Lanes::Mask a, b;
    friend HWY_INLINE HWY_ATTR Mask operator&(const Mask& x, const Mask& y) { return {x.a & y.a, x.b & y.b}; }
    friend HWY_INLINE HWY_ATTR Mask operator|(const Mask& x, const Mask& y) { return {x.a | y.a, x.b | y.b}; }
    friend HWY_INLINE HWY_ATTR Mask operator!(const Mask& x) { return {!x.a, !x.b}; }
    friend HWY_INLINE HWY_ATTR bool any(const Mask& m) { return any(m.a | m.b); }
  };
  Lanes a, b;

  HWY_INLINE HWY_ATTR LanePair() {}
  HWY_INLINE HWY_ATTR LanePair(Lanes x, Lanes y) : a(x), b(y) {}
  HWY_INLINE HWY_ATTR LanePair(float x) : a(x), b(x) {}
  static constexpr int size() { return 2 * Lanes::size(); }
  static HWY_INLINE HWY_ATTR LanePair index(int first) { return {Lanes::index(first), Lanes::index(first + Lanes::size())}; }

#define RAINREF_PAIRWISE(result, op) \
  friend HWY_INLINE HWY_ATTR result operator op(const LanePair& x, const LanePair& y) { return {x.a op y.a, x.b op y.b}; }
  RAINREF_PAIRWISE(LanePair, +)
  RAINREF_PAIRWISE(LanePair, -)
  RAINREF_PAIRWISE(LanePair, *)
  RAINREF_PAIRWISE(LanePair, /)
  RAINREF_PAIRWISE(Mask, <)
  RAINREF_PAIRWISE(Mask, <=)
  RAINREF_PAIRWISE(Mask, >)
  RAINREF_PAIRWISE(Mask, >=)
#undef RAINREF_PAIRWISE
#define RAINREF_PAIRWISE(function) \
  friend HWY_INLINE HWY_ATTR LanePair function(const LanePair& x) { return {function(x.a), function(x.b)}; }
  RAINREF_PAIRWISE(operator-)
  RAINREF_PAIRWISE(abs)
  RAINREF_PAIRWISE(sqrt)
  RAINREF_PAIRWISE(square)
  RAINREF_PAIRWISE(floor)
  RAINREF_PAIRWISE(fract)
#undef RAINREF_PAIRWISE
  friend HWY_INLINE HWY_ATTR LanePair min(const LanePair& x, const LanePair& y) { return {min(x.a, y.a), min(x.b, y.b)}; }
  friend HWY_INLINE HWY_ATTR LanePair max(const LanePair& x, const LanePair& y) { return {max(x.a, y.a), max(x.b, y.b)}; }
  friend HWY_INLINE HWY_ATTR LanePair mix(const LanePair& x, const LanePair& y, const LanePair& t) {
    return {mix(x.a, y.a, t.a), mix(x.b, y.b, t.b)};
  }
  friend HWY_INLINE HWY_ATTR LanePair select(const Mask& m, const LanePair& x, const LanePair& y) {
    return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
  }
};

HWY_INLINE HWY_ATTR Real64Two to_double(const LanePair& x) { return Real64Two(to_double(x.a.v), to_double(x.b.v)); }
// Not inlined: see exp_lanes.
inline HWY_NOINLINE LanePair exp(const LanePair& x) {
  const Real64Two y = exp_real(to_double(x));
  return LanePair(Lanes(to_float(y.lower)), Lanes(to_float(y.upper)));
}
inline HWY_NOINLINE LanePair pow(const LanePair& x, const LanePair& y) {
  const Real64Two z = pow_real(to_double(x), to_double(y));
  return LanePair(Lanes(to_float(z.lower)), Lanes(to_float(z.upper)));
}
/// As for a vector; count is at most size().
HWY_INLINE HWY_ATTR void store(float* p, const LanePair& x, Rounding rounding, int count) {
  constexpr int n = Lanes::size();
  if (HWY_LIKELY(count == 2 * n)) {
    store(p, x.a, rounding, n);
    store(p + n, x.b, rounding, n);
  } else {
    store(p, x.a, rounding, count < n ? count : n);
    if (count > n) store(p + n, x.b, rounding, count - n);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

#endif  // RAINREF_MATH_LANE_PAIR_INL_H_
