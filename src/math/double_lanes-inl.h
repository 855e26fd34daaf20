// The oracle's arithmetic in lanes: a number is a vector of doubles, and every lane has the bits of scalar::Scalar<double>.
//
// For pass formulas that the compositor evaluates in double for many positions at once. Re-included for every target; see foreach_target.h.
#if defined(RAINREF_MATH_DOUBLE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_MATH_DOUBLE_LANES_INL_H_
#undef RAINREF_MATH_DOUBLE_LANES_INL_H_
#else
#define RAINREF_MATH_DOUBLE_LANES_INL_H_
#endif

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {

// Its functions name the target (HWY_ATTR): see Real64Lanes.
struct DoubleLanes {
  using D = Real64Lanes::D;
  using DI = hn::Rebind<std::int32_t, D>;
  using V = hn::Vec<D>;

  struct Mask {
    hn::Mask<D> m;
    friend HWY_INLINE HWY_ATTR Mask operator&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
    friend HWY_INLINE HWY_ATTR Mask operator|(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
    friend HWY_INLINE HWY_ATTR Mask operator!(Mask a) { return {hn::Not(a.m)}; }
  };

  /// Texel index: made by to_int, used by fetch.
  struct Int {
    hn::Vec<DI> i;
    HWY_INLINE HWY_ATTR Int() {}
    HWY_INLINE HWY_ATTR Int(hn::Vec<DI> x) : i(x) {}
    friend HWY_INLINE HWY_ATTR Int operator+(Int a, std::int32_t b) { return {hn::Add(a.i, hn::Set(DI(), b))}; }
    friend HWY_INLINE HWY_ATTR Int operator+(Int a, Int b) { return {hn::Add(a.i, b.i)}; }
    friend HWY_INLINE HWY_ATTR Int operator*(Int a, std::int32_t b) { return {hn::Mul(a.i, hn::Set(DI(), b))}; }
    friend HWY_INLINE HWY_ATTR Int operator*(Int a, Int b) { return {hn::Mul(a.i, b.i)}; }
    friend HWY_INLINE HWY_ATTR Int clamp_index(Int a, Int size) {
      return {hn::Max(hn::Min(a.i, hn::Sub(size.i, hn::Set(DI(), 1))), hn::Zero(DI()))};
    }
    friend HWY_INLINE HWY_ATTR Int wrap_index(Int a, Int size) {
      const auto below = hn::Lt(a.i, hn::Zero(DI())), within = hn::Lt(a.i, size.i);
      return {hn::IfThenElse(below, hn::Add(a.i, size.i), hn::IfThenElse(within, a.i, hn::Sub(a.i, size.i)))};
    }
    /// Textures sampled by lanes of doubles have no border.
    friend HWY_INLINE HWY_ATTR Mask inside(Int, Int) { return {hn::Eq(hn::Zero(D()), hn::Zero(D()))}; }
    friend HWY_INLINE HWY_ATTR Int max_index(Int a, Int b) { return {hn::Max(a.i, b.i)}; }
    friend HWY_INLINE HWY_ATTR Int shift_right(Int a, Int b) { return {hn::Shr(a.i, b.i)}; }
    friend HWY_INLINE HWY_ATTR Int lookup(const std::int32_t* table, Int a) { return {hn::GatherIndex(DI(), table, a.i)}; }
  };

  V v;

  HWY_INLINE HWY_ATTR DoubleLanes() {}
  HWY_INLINE HWY_ATTR DoubleLanes(V x) : v(x) {}
  HWY_INLINE HWY_ATTR DoubleLanes(Real64Lanes x) : v(x.v) {}
  HWY_INLINE HWY_ATTR DoubleLanes(double x) : v(hn::Set(D(), x)) {}
  static constexpr int size() { return static_cast<int>(hn::MaxLanes(D())); }
  static HWY_INLINE HWY_ATTR DoubleLanes load(const double* p) { return hn::LoadU(D(), p); }
  static HWY_INLINE HWY_ATTR Int uniform_int(int value) { return {hn::Set(DI(), value)}; }

  friend HWY_INLINE HWY_ATTR DoubleLanes operator+(DoubleLanes a, DoubleLanes b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR DoubleLanes operator-(DoubleLanes a, DoubleLanes b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR DoubleLanes operator*(DoubleLanes a, DoubleLanes b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR DoubleLanes operator/(DoubleLanes a, DoubleLanes b) { return quotient(D(), a.v, b.v); }
  friend HWY_INLINE HWY_ATTR DoubleLanes operator-(DoubleLanes a) { return hn::Neg(a.v); }
  friend HWY_INLINE HWY_ATTR Mask operator<(DoubleLanes a, DoubleLanes b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator<=(DoubleLanes a, DoubleLanes b) { return {hn::Le(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator>(DoubleLanes a, DoubleLanes b) { return {hn::Gt(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator>=(DoubleLanes a, DoubleLanes b) { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR DoubleLanes select(Mask m, DoubleLanes a, DoubleLanes b) { return hn::IfThenElse(m.m, a.v, b.v); }
  friend HWY_INLINE HWY_ATTR DoubleLanes min(DoubleLanes a, DoubleLanes b) { return select(b < a, b, a); }
  friend HWY_INLINE HWY_ATTR DoubleLanes max(DoubleLanes a, DoubleLanes b) { return select(a < b, b, a); }
  friend HWY_INLINE HWY_ATTR DoubleLanes abs(DoubleLanes a) { return select(a < DoubleLanes(0.0), -a, a); }
  friend HWY_INLINE HWY_ATTR DoubleLanes sqrt(DoubleLanes a) { return hn::Sqrt(a.v); }
  friend HWY_INLINE HWY_ATTR DoubleLanes square(DoubleLanes a) { return a * a; }
  // + 0 makes the zero positive, because targets differ in the sign of floor(-0).
  friend HWY_INLINE HWY_ATTR DoubleLanes floor(DoubleLanes a) { return hn::Add(hn::Floor(a.v), hn::Zero(D())); }
  friend HWY_INLINE HWY_ATTR DoubleLanes fract(DoubleLanes a) { return a - floor(a); }
  friend HWY_INLINE HWY_ATTR DoubleLanes mix(DoubleLanes a, DoubleLanes b, DoubleLanes t) { return a * (DoubleLanes(1.0) - t) + b * t; }
  friend HWY_INLINE HWY_ATTR Int to_int(DoubleLanes a) { return {hn::DemoteTo(DI(), a.v)}; }
  friend HWY_INLINE HWY_ATTR DoubleLanes to_number(Int a) { return hn::PromoteTo(D(), a.i); }
  friend HWY_INLINE HWY_ATTR bool any(Mask m) { return !hn::AllFalse(D(), m.m); }

  friend HWY_INLINE HWY_ATTR DoubleLanes exp(DoubleLanes a) { return exp_real(Real64Lanes(a.v)); }
  friend HWY_INLINE HWY_ATTR DoubleLanes atan2(DoubleLanes y, DoubleLanes x) { return atan2_real(Real64Lanes(y.v), Real64Lanes(x.v)); }
  friend HWY_INLINE HWY_ATTR DoubleLanes fetch(const float* texels, Int offset, DoubleLanes) {
    return widen(hn::GatherIndex(NarrowTag(), texels, offset.i));
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

#endif  // RAINREF_MATH_DOUBLE_LANES_INL_H_
