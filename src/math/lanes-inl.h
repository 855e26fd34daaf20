// The reference evaluation: a number is a vector of floats, one lane for each output element.
//
// No operation crosses lanes, so the bits of an element do not depend on the width. Left out on purpose: no fused multiply-add of a product
// that is rounded, no reciprocal or square-root estimates, no hn::Min/Max (signed zeros differ between targets), no hn::DemoteTo(float16)
// below F16C (it truncates), no sums over lanes. Re-included for every target; see foreach_target.h.
#if defined(RAINREF_MATH_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_MATH_LANES_INL_H_
#undef RAINREF_MATH_LANES_INL_H_
#else
#define RAINREF_MATH_LANES_INL_H_
#endif

#include <bit>

#include "hwy/highway.h"
#include "math/real64_lanes-inl.h"
#include "rainref/storage.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Its functions name the target (HWY_ATTR): see Real64Lanes.
struct Lanes {
  using D = hn::ScalableTag<float>;
  using DI = hn::RebindToSigned<D>;
  using DU = hn::RebindToUnsigned<D>;
  using DH = hn::Rebind<std::uint16_t, D>;
  using DB = hn::Rebind<std::uint8_t, D>;
  using V = hn::Vec<D>;

  struct Mask {
    hn::Mask<D> m;
    HWY_ATTR Mask() {}  // not implicit, because that would not be compiled for the target
    HWY_INLINE HWY_ATTR Mask(hn::Mask<D> x) : m(x) {}
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
    friend HWY_INLINE HWY_ATTR Int clamp_index(Int a, Int size) {
      return {hn::Max(hn::Min(a.i, hn::Sub(size.i, hn::Set(DI(), 1))), hn::Zero(DI()))};
    }
    friend HWY_INLINE HWY_ATTR Int wrap_index(Int a, Int size) {
      const auto below = hn::Lt(a.i, hn::Zero(DI())), within = hn::Lt(a.i, size.i);
      return {hn::IfThenElse(below, hn::Add(a.i, size.i), hn::IfThenElse(within, a.i, hn::Sub(a.i, size.i)))};
    }
    friend HWY_INLINE HWY_ATTR Mask inside(Int a, Int size) {
      // As an unsigned number a negative index is above every size.
      return {hn::RebindMask(D(), hn::Lt(hn::BitCast(DU(), a.i), hn::BitCast(DU(), size.i)))};
    }
    friend HWY_INLINE HWY_ATTR Int max_index(Int a, Int b) { return {hn::Max(a.i, b.i)}; }
    /// a / 2^b, rounded down; b in [0, 31].
    friend HWY_INLINE HWY_ATTR Int shift_right(Int a, Int b) { return {hn::Shr(a.i, b.i)}; }
    /// table[a]
    friend HWY_INLINE HWY_ATTR Int lookup(const std::int32_t* table, Int a) { return {hn::GatherIndex(DI(), table, a.i)}; }
    friend HWY_INLINE HWY_ATTR Int operator*(Int a, Int b) { return {hn::Mul(a.i, b.i)}; }
    friend HWY_INLINE HWY_ATTR Int operator+(Int a, Int b) { return {hn::Add(a.i, b.i)}; }
    friend HWY_INLINE HWY_ATTR Int operator*(Int a, std::int32_t b) { return {hn::Mul(a.i, hn::Set(DI(), b))}; }
  };

  V v;

  HWY_INLINE HWY_ATTR Lanes() {}
  HWY_INLINE HWY_ATTR Lanes(V x) : v(x) {}
  HWY_INLINE HWY_ATTR Lanes(float x) : v(hn::Set(D(), x)) {}
  static constexpr int size() { return static_cast<int>(hn::MaxLanes(D())); }

  static HWY_INLINE HWY_ATTR Lanes load(const float* p) { return hn::LoadU(D(), p); }
  static HWY_INLINE HWY_ATTR Lanes load(const Half* p) {
#if HWY_TARGET <= HWY_AVX2 && HWY_TARGET != HWY_SCALAR
    return hn::PromoteTo(D(), hn::LoadU(hn::Rebind<hwy::float16_t, D>(), reinterpret_cast<const hwy::float16_t*>(p)));
#else
    return of_half_codes(hn::PromoteTo(DU(), hn::LoadU(DH(), reinterpret_cast<const std::uint16_t*>(p))));
#endif
  }
  /// The numbers of half codes.
  static HWY_INLINE HWY_ATTR Lanes of_half_codes(hn::Vec<DU> bits) {
    // A multiplication by 2^112 moves the exponent; it is exact, also for subnormals. An infinity, which an overflowing store leaves, would
    // become 2^16.
    const auto code = hn::And(bits, hn::Set(DU(), 0x7fffu));
    const auto sign = hn::BitCast(D(), hn::ShiftLeft<16>(hn::And(bits, hn::Set(DU(), 0x8000u))));
    const V scaled = hn::Mul(hn::BitCast(D(), hn::ShiftLeft<13>(code)), hn::Set(D(), 0x1p112f));
    const auto infinite = hn::BitCast(D(), hn::IfThenElseZero(hn::Eq(code, hn::Set(DU(), 0x7c00u)), hn::Set(DU(), 0x7f800000u)));
    return hn::Or(hn::Or(scaled, infinite), sign);
  }
  /// The numbers of 8-bit codes.
  static HWY_INLINE HWY_ATTR Lanes of_unorm8_codes(hn::Vec<DI> codes) { return hn::Div(hn::ConvertTo(D(), codes), hn::Set(D(), 255.0f)); }
  static HWY_INLINE HWY_ATTR Lanes load(const Unorm8* p) {
    return of_unorm8_codes(hn::PromoteTo(DI(), hn::LoadU(DB(), reinterpret_cast<const std::uint8_t*>(p))));
  }
  /// The last element of `before`, then all but the last of `here`.
  static HWY_INLINE HWY_ATTR Lanes shifted_up(Lanes before, Lanes here) {
#if HWY_TARGET == HWY_SCALAR
    (void)here;
    return before;
#elif HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    return V{_mm512_castsi512_ps(_mm512_alignr_epi32(_mm512_castps_si512(here.v.raw), _mm512_castps_si512(before.v.raw), 15))};
#elif HWY_TARGET == HWY_AVX2
    return hn::CombineShiftRightBytes<12>(D(), here.v, hn::ConcatLowerUpper(D(), here.v, before.v));
#else
    return hn::CombineShiftRightBytes<12>(D(), here.v, before.v);
#endif
  }
  /// All but the first element of `here`, then the first of `after`.
  static HWY_INLINE HWY_ATTR Lanes shifted_down(Lanes here, Lanes after) {
#if HWY_TARGET == HWY_SCALAR
    (void)here;
    return after;
#elif HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    return V{_mm512_castsi512_ps(_mm512_alignr_epi32(_mm512_castps_si512(after.v.raw), _mm512_castps_si512(here.v.raw), 1))};
#elif HWY_TARGET == HWY_AVX2
    return hn::CombineShiftRightBytes<4>(D(), hn::ConcatLowerUpper(D(), after.v, here.v), here.v);
#else
    return hn::CombineShiftRightBytes<4>(D(), after.v, here.v);
#endif
  }
  static HWY_INLINE HWY_ATTR Lanes index(int first) { return hn::ConvertTo(D(), hn::Iota(DI(), first)); }
  static HWY_INLINE HWY_ATTR Int uniform_int(int value) { return {hn::Set(DI(), value)}; }

  friend HWY_INLINE HWY_ATTR Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Lanes operator/(Lanes a, Lanes b) { return quotient(D(), a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Lanes operator-(Lanes a) { return hn::Neg(a.v); }
  friend HWY_INLINE HWY_ATTR Mask operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator<=(Lanes a, Lanes b) { return {hn::Le(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator>(Lanes a, Lanes b) { return {hn::Gt(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Mask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE HWY_ATTR Lanes select(Mask m, Lanes a, Lanes b) { return hn::IfThenElse(m.m, a.v, b.v); }
  // b < a ? b : a and a < b ? b : a. MINPS and MAXPS compute exactly this, including signed zeros, as do pmin and pmax of WebAssembly. The
  // minimum and maximum of other targets differ for signed zeros.
#if HWY_TARGET == HWY_WASM || (HWY_TARGET <= HWY_SSSE3 && HWY_ARCH_X86)
  friend HWY_INLINE HWY_ATTR Lanes min(Lanes a, Lanes b) { return hn::Min(b.v, a.v); }
  friend HWY_INLINE HWY_ATTR Lanes max(Lanes a, Lanes b) { return hn::Max(b.v, a.v); }
#else
  friend HWY_INLINE HWY_ATTR Lanes min(Lanes a, Lanes b) { return hn::IfThenElse(hn::Lt(b.v, a.v), b.v, a.v); }
  friend HWY_INLINE HWY_ATTR Lanes max(Lanes a, Lanes b) { return hn::IfThenElse(hn::Lt(a.v, b.v), b.v, a.v); }
#endif
  friend HWY_INLINE HWY_ATTR Lanes abs(Lanes a) { return hn::IfThenElse(hn::Lt(a.v, hn::Zero(D())), hn::Neg(a.v), a.v); }
  // The product is exact, so the difference is rounded once, with or without a fused multiply-add.
  friend HWY_INLINE HWY_ATTR Lanes minus_four_times(Lanes a, Lanes b) { return hn::NegMulAdd(hn::Set(D(), 4.0f), b.v, a.v); }
  friend HWY_INLINE HWY_ATTR Lanes sqrt(Lanes a) { return hn::Sqrt(a.v); }
  friend HWY_INLINE HWY_ATTR Lanes square(Lanes a) { return a * a; }
  // + 0 makes the zero positive, because targets differ in the sign of floor(-0).
  friend HWY_INLINE HWY_ATTR Lanes floor(Lanes a) { return hn::Add(hn::Floor(a.v), hn::Zero(D())); }
  friend HWY_INLINE HWY_ATTR Lanes fract(Lanes a) { return a - floor(a); }
  friend HWY_INLINE HWY_ATTR Lanes mix(Lanes a, Lanes b, Lanes t) { return a * (Lanes(1.0f) - t) + b * t; }
  /// Truncates; |a| < 2^31, which every caller ensures. Beyond that targets differ.
  friend HWY_INLINE HWY_ATTR Int to_int(Lanes a) {
    // hn::ConvertTo saturates, which costs four more instructions than the conversion.
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
    return {hn::Vec<DI>{_mm512_cvttps_epi32(a.v.raw)}};
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
    return {hn::Vec<DI>{_mm256_cvttps_epi32(a.v.raw)}};
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_SSSE3
    return {hn::Vec<DI>{_mm_cvttps_epi32(a.v.raw)}};
#else
    return {hn::ConvertTo(DI(), a.v)};
#endif
  }
  friend HWY_INLINE HWY_ATTR Lanes to_number(Int a) { return hn::ConvertTo(D(), a.i); }
  friend HWY_INLINE HWY_ATTR bool any(Mask m) { return !hn::AllFalse(D(), m.m); }

  friend HWY_INLINE HWY_ATTR Lanes exp(Lanes a) { return exp_lanes(a.v); }
  friend HWY_INLINE HWY_ATTR Lanes exp2(Lanes a) { return exp2_lanes(a.v); }
  friend HWY_INLINE HWY_ATTR Lanes log(Lanes a) { return log_lanes(a.v); }
  friend HWY_INLINE HWY_ATTR Lanes pow(Lanes a, Lanes b) { return pow_lanes(a.v, b.v); }
  friend HWY_INLINE HWY_ATTR Lanes sin(Lanes a) { return sin_lanes(a.v); }
  friend HWY_INLINE HWY_ATTR Lanes cos(Lanes a) { return cos_lanes(a.v); }
  friend HWY_INLINE HWY_ATTR Lanes atan2(Lanes y, Lanes x) { return atan2_lanes(y.v, x.v); }

  friend HWY_INLINE HWY_ATTR Lanes fetch(const float* texels, Int offset, Lanes) { return hn::GatherIndex(D(), texels, offset.i); }
  /// For neighbouring elements that mostly need neighbouring texels: those are one load, while a gather costs per element.
  friend HWY_INLINE HWY_ATTR Lanes fetch_near(const float* texels, Int offset, Lanes) {
    const std::int32_t first = hn::GetLane(offset.i);
    if (hn::AllTrue(DI(), hn::Eq(offset.i, hn::Iota(DI(), first)))) return hn::LoadU(D(), texels + first);
    return hn::GatherIndex(D(), texels, offset.i);
  }

  friend HWY_INLINE HWY_ATTR Lanes fetch(const Half* texels, Int offset, Lanes) {
    HWY_ALIGN std::int32_t places[HWY_MAX_BYTES / sizeof(std::int32_t)];
    Half halves[HWY_MAX_BYTES / sizeof(std::int32_t)];
    hn::Store(offset.i, DI(), places);
    for (int k = 0; k < size(); ++k) halves[k] = texels[places[k]];
    return load(halves);
  }

  /// Half codes in 16-bit lanes; -0 becomes +0, or may be either if `either_zero`.
  template <bool either_zero = false>
  HWY_INLINE HWY_ATTR hn::Vec<DH> half_codes(Rounding rounding) const {
#if HWY_TARGET <= HWY_AVX2 && HWY_TARGET != HWY_SCALAR
    if (rounding == Rounding::rne)
      return hn::BitCast(DH(), hn::DemoteTo(hn::Rebind<hwy::float16_t, D>(), either_zero ? v : hn::Add(v, hn::Zero(D()))));
#endif
    return hn::DemoteTo(DH(), hn::BitCast(DI(), half_words(rounding)));
  }
  /// The same in 32-bit lanes.
  HWY_INLINE HWY_ATTR hn::Vec<DU> half_words(Rounding rounding) const {
    const V x = hn::Add(v, hn::Zero(D()));
#if HWY_TARGET <= HWY_AVX2 && HWY_TARGET != HWY_SCALAR
    const auto nearest = hn::DemoteTo(hn::Rebind<hwy::float16_t, D>(), x);
    const auto codes = hn::PromoteTo(DU(), hn::BitCast(DH(), nearest));
    if (rounding == Rounding::rne) return codes;
    const V back = hn::PromoteTo(D(), nearest);
#else
    const auto bits = hn::BitCast(DU(), x), sign = hn::And(hn::ShiftRight<16>(bits), hn::Set(DU(), 0x8000u));
    // Everything that rounds to infinity is replaced by 65520, the smallest such number. Bits of positive floats are ordered like their
    // values.
    const auto magnitude = hn::Min(hn::BitCast(DI(), hn::And(bits, hn::Set(DU(), 0x7fffffffu))), hn::Set(DI(), 0x477ff000));
    const auto odd = hn::And(hn::ShiftRight<13>(magnitude), hn::Set(DI(), 1));
    // Normal halves: adds just under half a code, one more if the code is odd, and moves the exponent by 112.
    const auto normal = hn::ShiftRight<13>(hn::Add(hn::Add(magnitude, hn::Set(DI(), 0xfff - 0x38000000)), odd));
    // Subnormal halves: the addition 0.5 + x rounds at 2^-24, to even. Below 2^-14 this code is the larger of the two. From there to 2^-13
    // both are equal. Beyond, x is limited to 2^-13, so the normal code is larger.
    const V held = hn::BitCast(D(), hn::Min(magnitude, hn::Set(DI(), 0x39000000)));
    const auto subnormal = hn::Sub(hn::BitCast(DI(), hn::Add(held, hn::Set(D(), 0.5f))), hn::Set(DI(), 0x3f000000));
    const auto code = hn::BitCast(DU(), hn::Max(normal, subnormal));
    const auto codes = hn::Or(code, sign);
    if (rounding == Rounding::rne) return codes;
    const auto finite = hn::BitCast(D(), hn::ShiftLeft<13>(code));
    const V scaled = hn::Mul(finite, hn::Set(D(), 0x1p112f));
    const V infinity = hn::BitCast(D(), hn::Set(DU(), 0x7f800000u));
    const V back = hn::IfThenElse(hn::RebindMask(D(), hn::Eq(code, hn::Set(DU(), 0x7c00u))), infinity, scaled);
#endif
    // Toward zero: one code less if the nearest half is larger in magnitude.
    const auto out = hn::Gt(hn::Abs(back), hn::Abs(x));
    return hn::IfThenElse(hn::RebindMask(DU(), out), hn::Sub(codes, hn::Set(DU(), 1u)), codes);
  }
  /// 8-bit codes, as to_unorm8.
  HWY_INLINE HWY_ATTR hn::Vec<DB> unorm8_codes(Rounding rounding) const {
    const Lanes scaled = min(max(*this, Lanes(0.0f)), Lanes(1.0f)) * Lanes(255.0f), magic(0x1p23f);
    const Lanes value = rounding == Rounding::rne ? (scaled + magic) - magic : scaled;
    return hn::DemoteTo(DB(), hn::ConvertTo(DI(), value.v));
  }
};

/// Writes the first `count` lanes in the storage type, rounded; count is at most size().
HWY_INLINE void store(float* p, Lanes x, Rounding, int count) {
  const Lanes::D d;
  const Lanes::V v = hn::Add(x.v, hn::Zero(d));
  if (HWY_LIKELY(count == Lanes::size())) return hn::StoreU(v, d, p);
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(v, d, lanes);
  for (int k = 0; k < count; ++k) p[k] = lanes[k];
}
/// Half codes as stored: a small negative number that rounds to zero becomes +0, so adding nothing to a stored value never changes its
/// bits.
HWY_INLINE hn::Vec<Lanes::DH> stored_half(Lanes x, Rounding rounding) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  // The bits of -0 and of the negative numbers down to -2^-25, which all become 0, are the smallest signed integers. This check takes one
  // instruction less than checking the codes, and the masked conversion is free.
  if (rounding == Rounding::rne) {
    const __mmask16 kept = _mm512_cmpgt_epi32_mask(_mm512_castps_si512(x.v.raw), _mm512_set1_epi32(std::bit_cast<int>(-0x1p-25f)));
    return hn::Vec<Lanes::DH>{_mm512_maskz_cvtps_ph(kept, x.v.raw, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC)};
  }
#endif
  const auto codes = x.half_codes<true>(rounding);
  return hn::IfThenZeroElse(hn::Eq(codes, hn::Set(Lanes::DH(), std::uint16_t{0x8000})), codes);
}
HWY_INLINE void store(Half* p, Lanes x, Rounding rounding, int count) {
  const Lanes::DH d;
  const auto codes = stored_half(x, rounding);
  if (HWY_LIKELY(count == Lanes::size())) return hn::StoreU(codes, d, reinterpret_cast<std::uint16_t*>(p));
  HWY_ALIGN std::uint16_t lanes[HWY_MAX_BYTES / sizeof(std::uint16_t)];
  hn::StoreU(codes, d, lanes);
  for (int k = 0; k < count; ++k) p[k].bits = lanes[k];
}
HWY_INLINE void store(Unorm8* p, Lanes x, Rounding rounding, int count) {
  const auto codes = x.unorm8_codes(rounding);
  if (HWY_LIKELY(count == Lanes::size())) return hn::StoreU(codes, Lanes::DB(), reinterpret_cast<std::uint8_t*>(p));
  HWY_ALIGN std::uint8_t lanes[HWY_MAX_BYTES];
  hn::StoreU(codes, Lanes::DB(), lanes);
  for (int k = 0; k < count; ++k) p[k].code = lanes[k];
}

/// Like store of a whole vector, if no lane can be -0; saves an addition.
HWY_INLINE void store_without_minus_zero(float* p, Lanes x, Rounding) { hn::StoreU(x.v, Lanes::D(), p); }
template <class Storage>
HWY_INLINE void store_without_minus_zero(Storage* p, Lanes x, Rounding rounding) {
  store(p, x, rounding, Lanes::size());
}

/// Four interleaved channels of size() texels. Rows of an Image have room for whole vectors, so there is no tail.
HWY_INLINE void load4(const float* p, Lanes (&c)[4]) { hn::LoadInterleaved4(Lanes::D(), p, c[0].v, c[1].v, c[2].v, c[3].v); }
#undef RAINREF_HALF_TEXELS
#if (HWY_TARGET > HWY_AVX2 || !HWY_ARCH_X86) && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#define RAINREF_HALF_TEXELS 1  // without half instructions, two channels at a time are a 32-bit word of a vector of four
#else
#define RAINREF_HALF_TEXELS 0
#endif
HWY_INLINE void load4(const Half* p, Lanes (&c)[4]) {
#if RAINREF_HALF_TEXELS
  const Lanes::DU d;
  const std::uint32_t* const words = reinterpret_cast<const std::uint32_t*>(p);
  const auto low = hn::LoadU(d, words), high = hn::LoadU(d, words + 4), mask = hn::Set(d, 0xffffu);
  const auto rg = hn::ConcatEven(d, high, low), ba = hn::ConcatOdd(d, high, low);
  c[0] = Lanes::of_half_codes(hn::And(rg, mask));
  c[1] = Lanes::of_half_codes(hn::ShiftRight<16>(rg));
  c[2] = Lanes::of_half_codes(hn::And(ba, mask));
  c[3] = Lanes::of_half_codes(hn::ShiftRight<16>(ba));
#else
  const Lanes::DH d;
  auto r = hn::Zero(d), g = r, b = r, a = r;
  hn::LoadInterleaved4(d, reinterpret_cast<const std::uint16_t*>(p), r, g, b, a);
#if HWY_TARGET <= HWY_AVX2 && HWY_TARGET != HWY_SCALAR
  const auto widen = [](auto v)
                         HWY_ATTR { return Lanes(hn::PromoteTo(Lanes::D(), hn::BitCast(hn::Rebind<hwy::float16_t, Lanes::D>(), v))); };
#else
  const auto widen = [](auto v) HWY_ATTR { return Lanes::of_half_codes(hn::PromoteTo(Lanes::DU(), v)); };
#endif
  c[0] = widen(r);
  c[1] = widen(g);
  c[2] = widen(b);
  c[3] = widen(a);
#endif
}
/// A texel of four codes is one word of a lane.
HWY_INLINE void load4(const Unorm8* p, Lanes (&c)[4]) {
  const Lanes::DI d;
  const auto texel = hn::LoadU(Lanes::DU(), reinterpret_cast<const std::uint32_t*>(p)), mask = hn::Set(Lanes::DU(), 0xffu);
  c[0] = Lanes::of_unorm8_codes(hn::BitCast(d, hn::And(texel, mask)));
  c[1] = Lanes::of_unorm8_codes(hn::BitCast(d, hn::And(hn::ShiftRight<8>(texel), mask)));
  c[2] = Lanes::of_unorm8_codes(hn::BitCast(d, hn::And(hn::ShiftRight<16>(texel), mask)));
  c[3] = Lanes::of_unorm8_codes(hn::BitCast(d, hn::ShiftRight<24>(texel)));
}
HWY_INLINE void store4(float* p, const Lanes (&c)[4], Rounding) {
  const Lanes::D d;
  const auto zero = hn::Zero(d);
  hn::StoreInterleaved4(hn::Add(c[0].v, zero), hn::Add(c[1].v, zero), hn::Add(c[2].v, zero), hn::Add(c[3].v, zero), d, p);
}
HWY_INLINE void store4(Half* p, const Lanes (&c)[4], Rounding rounding) {
#if RAINREF_HALF_TEXELS
  const Lanes::DU d;
  const hn::Repartition<std::uint16_t, Lanes::DU> codes;
  const auto two = [&](Lanes low, Lanes high) HWY_ATTR __attribute__((always_inline)) {
    const auto both = hn::BitCast(codes, hn::Or(low.half_words(rounding), hn::ShiftLeft<16>(high.half_words(rounding))));
    return hn::BitCast(d, hn::IfThenZeroElse(hn::Eq(both, hn::Set(codes, std::uint16_t{0x8000})), both));  // as stored_half
  };
  const auto rg = two(c[0], c[1]), ba = two(c[2], c[3]);
  std::uint32_t* const words = reinterpret_cast<std::uint32_t*>(p);
  hn::StoreU(hn::InterleaveLower(d, rg, ba), d, words);
  hn::StoreU(hn::InterleaveUpper(d, rg, ba), d, words + 4);
#else
  hn::StoreInterleaved4(stored_half(c[0], rounding), stored_half(c[1], rounding), stored_half(c[2], rounding), stored_half(c[3], rounding),
                        Lanes::DH(), reinterpret_cast<std::uint16_t*>(p));
#endif
}
HWY_INLINE void store4(Unorm8* p, const Lanes (&c)[4], Rounding rounding) {
  hn::StoreInterleaved4(c[0].unorm8_codes(rounding), c[1].unorm8_codes(rounding), c[2].unorm8_codes(rounding), c[3].unorm8_codes(rounding),
                        Lanes::DB(), reinterpret_cast<std::uint8_t*>(p));
}

#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/vocabulary-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

// The same values as one after the other, but faster.
HWY_INLINE Vec3<Lanes> pow(const Vec3<Lanes>& a, Lanes b) {
  Lanes::V x[3] = {a.x.v, a.y.v, a.z.v};
  pow_lanes(x, b.v);
  return Vec3<Lanes>(x[0], x[1], x[2]);
}
HWY_INLINE Two<Lanes> atan2(const Two<Lanes>& y, const Two<Lanes>& x) {
  Lanes::V z[2] = {y.a.v, y.b.v};
  const Lanes::V w[2] = {x.a.v, x.b.v};
  atan2_lanes(z, w);
  return Two<Lanes>(z[0], z[1]);
}

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

#endif  // RAINREF_MATH_LANES_INL_H_
