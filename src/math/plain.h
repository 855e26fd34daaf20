// The scalar evaluations of a pass: Plain<float> defines the bits, Plain<double> is the oracle.
//
// Both offer exactly the interface that ARCHITECTURE.md lists for a number; lanes-inl.h offers it for SIMD lanes.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/half.h"
#include "math/real64.h"
#include "math/unorm.h"

namespace rainref::plain {

using rainref::to_float;
/// A load from storage widens exactly. double storage exists for the oracle's own state only.
inline double to_float(double x) { return x; }
inline float to_float(float x) { return x; }

/// Texel indices of a number N: made by to_int, used to fetch. One type for each N, so that to_number knows what to give.
template <class N>
struct Index {
  std::int32_t i;
  // Modulo 2^32: what is far outside an image is held inside it by clamp_index or wrap_index.
  friend Index operator+(Index a, std::int32_t b) { return of(word(a.i) + word(b)); }
  friend Index operator+(Index a, Index b) { return of(word(a.i) + word(b.i)); }
  friend Index operator*(Index a, std::int32_t b) { return of(word(a.i) * word(b)); }
  friend Index operator*(Index a, Index b) { return of(word(a.i) * word(b.i)); }
  /// a moved into [0, size): to the nearer end, or by whole periods. Lanes move by one, which is all that a pass needs of the
  /// reference's own numbers; here stands also what a port may have stored.
  friend Index clamp_index(Index a, Index size) { return {a.i < 0 ? 0 : a.i < size.i ? a.i : size.i - 1}; }
  friend Index wrap_index(Index a, Index size) {
    const std::int32_t rest = a.i % size.i;
    return {rest < 0 ? rest + size.i : rest};
  }
  friend bool inside(Index a, Index size) { return 0 <= a.i && a.i < size.i; }
  friend Index max_index(Index a, Index b) { return {a.i < b.i ? b.i : a.i}; }
  /// a / 2^b, rounded down; b in [0, 31].
  friend Index shift_right(Index a, Index b) { return {a.i >> b.i}; }
  friend Index lookup(const std::int32_t* table, Index a) { return {table[a.i]}; }

 private:
  static std::uint32_t word(std::int32_t i) { return static_cast<std::uint32_t>(i); }
  static Index of(std::uint32_t word) { return {static_cast<std::int32_t>(word)}; }
};

template <class T>
struct Plain {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>);
  using Mask = bool;
  using Int = Index<Plain>;
  static constexpr int size() { return 1; }

  T v;

  Plain() : v(0) {}
  Plain(float x) : v(x) {}
  template <class U, class = std::enable_if_t<std::is_same_v<U, double> && std::is_same_v<T, double>>>
  Plain(U x) : v(x) {}

  template <class Storage>
  static Plain load(const Storage* p) {
    return Plain(static_cast<T>(to_float(*p)));
  }
  /// The number first + lane, exact below 2^24.
  static Plain index(int first) { return Plain(static_cast<T>(first)); }
  static Int uniform_int(int value) { return {value}; }

  friend Plain operator+(Plain a, Plain b) { return Plain(a.v + b.v); }
  friend Plain operator-(Plain a, Plain b) { return Plain(a.v - b.v); }
  friend Plain operator*(Plain a, Plain b) { return Plain(a.v * b.v); }
  friend Plain operator/(Plain a, Plain b) { return Plain(a.v / b.v); }
  friend Plain operator-(Plain a) { return Plain(-a.v); }
  friend bool operator<(Plain a, Plain b) { return a.v < b.v; }
  friend bool operator<=(Plain a, Plain b) { return a.v <= b.v; }
  friend bool operator>(Plain a, Plain b) { return a.v > b.v; }
  friend bool operator>=(Plain a, Plain b) { return a.v >= b.v; }
  friend Plain select(bool m, Plain a, Plain b) { return m ? a : b; }
  friend Plain min(Plain a, Plain b) { return b.v < a.v ? b : a; }
  friend Plain max(Plain a, Plain b) { return a.v < b.v ? b : a; }
  friend Plain abs(Plain a) { return a.v < 0 ? Plain(-a.v) : a; }
  friend Plain sqrt(Plain a) {
    if constexpr (std::is_same_v<T, float>)
      return Plain(__builtin_sqrtf(a.v));
    else
      return Plain(__builtin_sqrt(a.v));
  }
  friend Plain square(Plain a) { return a * a; }
  /// Largest integer not above a; the zero is positive.
  friend Plain floor(Plain a) {
    constexpr T all_integers = std::is_same_v<T, float> ? T(0x1p23) : T(0x1p52);
    if (!(abs(a).v < all_integers)) return a;
    const T cut = static_cast<T>(static_cast<std::int64_t>(a.v));
    return Plain(cut > a.v ? cut - 1 : cut);
  }
  friend Plain fract(Plain a) { return a - floor(a); }
  /// a (1 - t) + b t, in this order.
  friend Plain mix(Plain a, Plain b, Plain t) { return a * (Plain(1.0f) - t) + b * t; }
  /// 0 for what no int32 is near, a NaN included.
  friend Int to_int(Plain a) { return {a.v > T(-0x1p30) && a.v < T(0x1p30) ? static_cast<std::int32_t>(a.v) : 0}; }
  friend Plain to_number(Int a) { return Plain(static_cast<T>(a.i)); }

  friend Plain exp(Plain a) { return real(exp_real(Real64{a.v})); }
  friend Plain exp2(Plain a) { return real(exp2_real(Real64{a.v})); }
  friend Plain log(Plain a) { return real(log_real(Real64{a.v})); }
  friend Plain pow(Plain a, Plain b) { return real(pow_real(Real64{a.v}, Real64{b.v})); }
  friend Plain sin(Plain a) { return real(sin_real(Real64{a.v})); }
  friend Plain cos(Plain a) { return real(cos_real(Real64{a.v})); }
  friend Plain atan2(Plain y, Plain x) { return real(atan2_real(Real64{y.v}, Real64{x.v})); }

  /// One channel of a decoded texel.
  friend Plain fetch(const float* texels, Int offset, Plain) { return Plain(static_cast<T>(texels[offset.i])); }

 private:
  static Plain real(Real64 x) {
    if constexpr (std::is_same_v<T, float>)
      return Plain(round_to_float(x));
    else
      return Plain(x.v);
  }
};

inline bool any(bool m) { return m; }

/// Stores one value in the storage type's own rounding.
inline void store(float* p, Plain<float> x, Rounding) { *p = x.v + 0.0f; }
/// A small negative number that rounds to zero is stored as +0.
inline void store(Half* p, Plain<float> x, Rounding rounding) {
  const Half rounded = to_half(x.v + 0.0f, rounding);
  *p = rounded.bits == 0x8000u ? Half{0} : rounded;
}
inline void store(Unorm8* p, Plain<float> x, Rounding rounding) { *p = to_unorm8(x.v, rounding); }
inline void store(double* p, Plain<double> x, Rounding) { *p = x.v; }

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/vocabulary-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::plain
