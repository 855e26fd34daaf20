// The scalar evaluations of a pass: Scalar<float> defines the bits, Scalar<double> is the oracle.
//
// Both offer exactly the interface that ARCHITECTURE.md lists for a number; lanes-inl.h offers it for SIMD lanes.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/half.h"
#include "math/real64.h"
#include "math/unorm.h"

namespace rainref::scalar {

using rainref::to_float;
/// A load from storage widens exactly. double storage exists only for the state of the oracle.
inline double to_float(double x) { return x; }
inline float to_float(float x) { return x; }

/// Texel index of a number type N: made by to_int, used by fetch. A separate type for each N, so that to_number knows its result type.
template <class N>
struct Index {
  std::int32_t i;
  // Modulo 2^32; clamp_index or wrap_index move indices far outside the image inside.
  friend Index operator+(Index a, std::int32_t b) { return of(word(a.i) + word(b)); }
  friend Index operator+(Index a, Index b) { return of(word(a.i) + word(b.i)); }
  friend Index operator*(Index a, std::int32_t b) { return of(word(a.i) * word(b)); }
  friend Index operator*(Index a, Index b) { return of(word(a.i) * word(b.i)); }
  /// a moved into [0, size): to the nearer end, or by whole periods. Lanes move by one period only, which is enough for the reference; this
  /// version also handles values stored by a port.
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
struct Scalar {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double>);
  using Mask = bool;
  using Int = Index<Scalar>;
  static constexpr int size() { return 1; }

  T v;

  Scalar() : v(0) {}
  Scalar(float x) : v(x) {}
  template <class U, class = std::enable_if_t<std::is_same_v<U, double> && std::is_same_v<T, double>>>
  Scalar(U x) : v(x) {}

  template <class Storage>
  static Scalar load(const Storage* p) {
    return Scalar(static_cast<T>(to_float(*p)));
  }
  /// The number first + lane, exact below 2^24.
  static Scalar index(int first) { return Scalar(static_cast<T>(first)); }
  static Int uniform_int(int value) { return {value}; }

  friend Scalar operator+(Scalar a, Scalar b) { return Scalar(a.v + b.v); }
  friend Scalar operator-(Scalar a, Scalar b) { return Scalar(a.v - b.v); }
  friend Scalar operator*(Scalar a, Scalar b) { return Scalar(a.v * b.v); }
  friend Scalar operator/(Scalar a, Scalar b) { return Scalar(a.v / b.v); }
  friend Scalar operator-(Scalar a) { return Scalar(-a.v); }
  friend bool operator<(Scalar a, Scalar b) { return a.v < b.v; }
  friend bool operator<=(Scalar a, Scalar b) { return a.v <= b.v; }
  friend bool operator>(Scalar a, Scalar b) { return a.v > b.v; }
  friend bool operator>=(Scalar a, Scalar b) { return a.v >= b.v; }
  friend Scalar select(bool m, Scalar a, Scalar b) { return m ? a : b; }
  friend Scalar min(Scalar a, Scalar b) { return b.v < a.v ? b : a; }
  friend Scalar max(Scalar a, Scalar b) { return a.v < b.v ? b : a; }
  friend Scalar abs(Scalar a) { return a.v < 0 ? Scalar(-a.v) : a; }
  friend Scalar sqrt(Scalar a) {
    if constexpr (std::is_same_v<T, float>)
      return Scalar(__builtin_sqrtf(a.v));
    else
      return Scalar(__builtin_sqrt(a.v));
  }
  friend Scalar square(Scalar a) { return a * a; }
  /// Largest integer not above a; a zero is positive.
  friend Scalar floor(Scalar a) {
    constexpr T all_integers = std::is_same_v<T, float> ? T(0x1p23) : T(0x1p52);
    if (!(abs(a).v < all_integers)) return a;
    const T cut = static_cast<T>(static_cast<std::int64_t>(a.v));
    return Scalar(cut > a.v ? cut - 1 : cut);
  }
  friend Scalar fract(Scalar a) { return a - floor(a); }
  /// a (1 - t) + b t, in this order.
  friend Scalar mix(Scalar a, Scalar b, Scalar t) { return a * (Scalar(1.0f) - t) + b * t; }
  /// 0 for numbers far outside int32, and for NaN.
  friend Int to_int(Scalar a) { return {a.v > T(-0x1p30) && a.v < T(0x1p30) ? static_cast<std::int32_t>(a.v) : 0}; }
  friend Scalar to_number(Int a) { return Scalar(static_cast<T>(a.i)); }

  friend Scalar exp(Scalar a) { return real(exp_real(Real64{a.v})); }
  friend Scalar exp2(Scalar a) { return real(exp2_real(Real64{a.v})); }
  friend Scalar log(Scalar a) { return real(log_real(Real64{a.v})); }
  friend Scalar pow(Scalar a, Scalar b) { return real(pow_real(Real64{a.v}, Real64{b.v})); }
  friend Scalar sin(Scalar a) { return real(sin_real(Real64{a.v})); }
  friend Scalar cos(Scalar a) { return real(cos_real(Real64{a.v})); }
  friend Scalar atan2(Scalar y, Scalar x) { return real(atan2_real(Real64{y.v}, Real64{x.v})); }

  /// One channel of a decoded texel.
  friend Scalar fetch(const float* texels, Int offset, Scalar) { return Scalar(static_cast<T>(texels[offset.i])); }

 private:
  static Scalar real(Real64 x) {
    if constexpr (std::is_same_v<T, float>)
      return Scalar(round_to_float(x));
    else
      return Scalar(x.v);
  }
};

inline bool any(bool m) { return m; }

/// Stores one value with the rounding of the storage type.
inline void store(float* p, Scalar<float> x, Rounding) { *p = x.v + 0.0f; }
/// A small negative number that rounds to zero is stored as +0.
inline void store(Half* p, Scalar<float> x, Rounding rounding) {
  const Half rounded = to_half(x.v + 0.0f, rounding);
  *p = rounded.bits == 0x8000u ? Half{0} : rounded;
}
inline void store(Unorm8* p, Scalar<float> x, Rounding rounding) { *p = to_unorm8(x.v, rounding); }
inline void store(double* p, Scalar<double> x, Rounding) { *p = x.v; }

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/vocabulary-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace rainref::scalar
