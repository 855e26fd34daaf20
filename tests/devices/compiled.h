// A float whose arithmetic is left to the compiler and whose functions are the C library's: a device for the judge that shares no
// assumption with it. What the compiler's flags allow it to do to sums and products, it does.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/half.h"
#include "math/scalar.h"
#include "math/unorm.h"

namespace rainref::devices {

struct Compiled {
  using Mask = bool;
  using Int = scalar::Index<Compiled>;
  static constexpr int size() { return 1; }

  float v = 0;

  Compiled() = default;
  Compiled(float x) : v(x) {}
  template <class Storage>
  static Compiled load(const Storage* p) {
    if constexpr (std::is_same_v<Storage, Unorm8>)
      return Compiled(static_cast<float>(p->code) / 255.0f);
    else
      return Compiled(scalar::to_float(*p));
  }
  static Compiled index(int first) { return Compiled(static_cast<float>(first)); }
  static Int uniform_int(int value) { return {value}; }

  friend Compiled operator+(Compiled a, Compiled b) { return a.v + b.v; }
  friend Compiled operator-(Compiled a, Compiled b) { return a.v - b.v; }
  friend Compiled operator*(Compiled a, Compiled b) { return a.v * b.v; }
  friend Compiled operator/(Compiled a, Compiled b) { return a.v / b.v; }
  friend Compiled operator-(Compiled a) { return -a.v; }
  friend bool operator<(Compiled a, Compiled b) { return a.v < b.v; }
  friend bool operator<=(Compiled a, Compiled b) { return a.v <= b.v; }
  friend bool operator>(Compiled a, Compiled b) { return a.v > b.v; }
  friend bool operator>=(Compiled a, Compiled b) { return a.v >= b.v; }
  friend Compiled select(bool m, Compiled a, Compiled b) { return m ? a : b; }
  friend Compiled min(Compiled a, Compiled b) { return b.v < a.v ? b : a; }
  friend Compiled max(Compiled a, Compiled b) { return a.v < b.v ? b : a; }
  friend Compiled abs(Compiled a) { return std::fabs(a.v); }
  friend Compiled sqrt(Compiled a) { return std::sqrt(a.v); }
  friend Compiled square(Compiled a) { return a.v * a.v; }
  friend Compiled floor(Compiled a) { return std::floor(a.v); }
  friend Compiled fract(Compiled a) { return a.v - std::floor(a.v); }
  friend Compiled mix(Compiled a, Compiled b, Compiled t) { return a.v * (1.0f - t.v) + b.v * t.v; }
  friend Int to_int(Compiled a) { return {static_cast<std::int32_t>(a.v)}; }
  friend Compiled to_number(Int a) { return Compiled(static_cast<float>(a.i)); }
  friend Compiled exp(Compiled a) { return std::exp(a.v); }
  friend Compiled exp2(Compiled a) { return std::exp2(a.v); }
  friend Compiled log(Compiled a) { return std::log(a.v); }
  friend Compiled pow(Compiled a, Compiled b) { return std::pow(a.v, b.v); }
  friend Compiled sin(Compiled a) { return std::sin(a.v); }
  friend Compiled cos(Compiled a) { return std::cos(a.v); }
  friend Compiled atan2(Compiled y, Compiled x) { return std::atan2(y.v, x.v); }
  /// What a pass rounds on its way, as the reference stores it.
  friend Compiled half_of(Compiled a, Rounding own) { return to_float(to_half(a.v, own)); }
  friend Compiled fetch(const float* texels, Int offset, Compiled) { return Compiled(texels[offset.i]); }
};

}  // namespace rainref::devices
