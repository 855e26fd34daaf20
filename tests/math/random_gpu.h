// A conforming GPU by lot: a number whose every operation draws one of the results that the profile in force allows.
// What it gives must lie inside the enclosure of the same expression. It shares no arithmetic with the enclosure.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "math/scalar.h"
#include "math/path_enumeration.h"

namespace rainref::random_gpu {

using enclosed::Accuracy;
using enclosed::Profile;

/// A float with room for a product and a sum of floats before they round.
#ifdef __SIZEOF_FLOAT128__
using Wide = __float128;
#else
using Wide = long double;
static_assert(__LDBL_MANT_DIG__ >= 113);
#endif

inline std::mt19937& words() {
  static std::mt19937 generator(20);
  return generator;
}
inline bool toss() { return words()() & 1; }
inline double uniform(double low, double high) { return low + (high - low) * (words()() * 0x1p-32); }
inline const Profile& rules() { return enclosed::profile(); }

/// Subnormals may count as zero.
inline float flushed(float x) {
  const bool subnormal = x != 0 && std::abs(x) < 0x1p-126f;
  return subnormal && rules().flush != enclosed::Flush::never && toss() ? std::copysign(0.0f, x) : x;
}
/// Either neighbour of an inexact result, or the nearest.
inline float rounded(Wide exact) {
  float f = static_cast<float>(exact);
  if (rules().basic == enclosed::BasicRounding::either && exact != f && toss()) f = std::nextafter(f, exact > f ? INFINITY : -INFINITY);
  return flushed(f);
}
/// A float within the accuracy of the exact y; often one at its edge.
inline float perturbed(double y, const Accuracy& a, double x = 0) {
  const float nearest = static_cast<float>(y);
  if (y == 0) return nearest;
  const double ulp = std::ldexp(1.0, std::max(std::ilogb(y), -126) - 23);
  const double bound = (a.ulp + a.ulp_per_x * std::abs(x)) * ulp + a.relative * std::abs(y) + a.absolute;
  const double shift = toss() ? uniform(-bound, bound) : toss() ? bound : -bound;
  const float f = static_cast<float>(y + shift);
  if (a.absolute == 0 && f != 0 && (f < 0) != (y < 0)) return flushed(nearest);
  return flushed(std::abs(static_cast<double>(f) - y) <= bound ? f : nearest);
}

struct RandomGpu {
  using Mask = bool;
  using Int = scalar::Index<RandomGpu>;
  static constexpr int size() { return 1; }

  float v = 0;
  Wide product = 0;  // before its rounding, for an addition that fuses
  bool is_product = false;

  RandomGpu() = default;
  RandomGpu(float x) : v(flushed(x)) {}
  static RandomGpu exactly(float x) {
    RandomGpu r;
    r.v = x;
    return r;
  }
  template <class Storage>
  static RandomGpu load(const Storage* p) {
    if constexpr (std::is_same_v<Storage, Unorm8>)
      return exactly(p->code == 0 || p->code == 255 ? to_float(*p) : perturbed(p->code / 255.0, rules().unorm_load));
    else
      return scalar::to_float(*p);
  }
  static RandomGpu index(int first) { return exactly(static_cast<float>(first)); }
  static Int uniform_int(int value) { return {value}; }

  friend RandomGpu operator+(RandomGpu a, RandomGpu b) {
    const bool fuses = rules().contraction && toss();
    if (fuses && a.is_product) return exactly(rounded(a.product + b.v));
    if (fuses && b.is_product) return exactly(rounded(a.v + b.product));
    return exactly(rounded(static_cast<Wide>(a.v) + b.v));
  }
  friend RandomGpu operator-(RandomGpu a) {
    a.v = -a.v;
    a.product = -a.product;
    return a;
  }
  friend RandomGpu operator-(RandomGpu a, RandomGpu b) { return a + -b; }
  friend RandomGpu operator*(RandomGpu a, RandomGpu b) {
    RandomGpu r;
    r.product = static_cast<Wide>(a.v) * b.v;
    r.is_product = true;
    r.v = rounded(r.product);
    return r;
  }
  friend RandomGpu operator/(RandomGpu a, RandomGpu b) {
    if (rules().division.is_zero()) return exactly(flushed(a.v / b.v));
    return exactly(perturbed(static_cast<double>(a.v) / b.v, rules().division));
  }
  friend bool operator<(RandomGpu a, RandomGpu b) { return a.v < b.v; }
  friend bool operator<=(RandomGpu a, RandomGpu b) { return a.v <= b.v; }
  friend bool operator>(RandomGpu a, RandomGpu b) { return a.v > b.v; }
  friend bool operator>=(RandomGpu a, RandomGpu b) { return a.v >= b.v; }
  friend RandomGpu select(bool m, RandomGpu a, RandomGpu b) { return m ? a : b; }
  friend RandomGpu min(RandomGpu a, RandomGpu b) { return exactly(std::min(a.v, b.v)); }
  friend RandomGpu max(RandomGpu a, RandomGpu b) { return exactly(std::max(a.v, b.v)); }
  friend RandomGpu abs(RandomGpu a) { return a.v < 0 ? -a : a; }
  friend RandomGpu square(RandomGpu a) { return a * a; }
  friend RandomGpu inverse_sqrt(RandomGpu a) { return exactly(perturbed(1 / std::sqrt(static_cast<double>(a.v)), rules().inverse_sqrt)); }
  friend RandomGpu sqrt(RandomGpu a) {
    if (a.v == 0) return a;
    if (rules().sqrt_is_inherited) return exactly(1.0f) / inverse_sqrt(a);
    return exactly(perturbed(std::sqrt(static_cast<double>(a.v)), rules().sqrt));
  }
  friend RandomGpu floor(RandomGpu a) { return exactly(std::floor(a.v)); }
  friend RandomGpu fract(RandomGpu a) { return a - floor(a); }
  friend Int to_int(RandomGpu a) { return {static_cast<std::int32_t>(a.v)}; }
  friend RandomGpu to_number(Int a) { return index(a.i); }
  friend RandomGpu mix(RandomGpu a, RandomGpu b, RandomGpu t) { return toss() ? a * (exactly(1.0f) - t) + b * t : a + (b - a) * t; }

  friend RandomGpu exp(RandomGpu a) { return exactly(perturbed(std::exp(static_cast<double>(a.v)), rules().exp, a.v)); }
  friend RandomGpu exp2(RandomGpu a) { return exactly(perturbed(std::exp2(static_cast<double>(a.v)), rules().exp2, a.v)); }
  friend RandomGpu log(RandomGpu a) {
    return exactly(perturbed(std::log(static_cast<double>(a.v)), near_one(a.v) ? rules().log_near_one : rules().log));
  }
  friend RandomGpu log2(RandomGpu a) {
    return exactly(perturbed(std::log2(static_cast<double>(a.v)), near_one(a.v) ? rules().log2_near_one : rules().log2));
  }
  friend RandomGpu pow(RandomGpu x, RandomGpu y) {
    if (x.v == 0) return exactly(0.0f);
    if (rules().pow_is_inherited) return exp2(y * log2(x));
    return exactly(perturbed(std::pow(static_cast<double>(x.v), static_cast<double>(y.v)), rules().pow));
  }
  friend RandomGpu sin(RandomGpu a) { return wave(std::sin(static_cast<double>(a.v)), a.v); }
  friend RandomGpu cos(RandomGpu a) { return wave(std::cos(static_cast<double>(a.v)), a.v); }
  friend RandomGpu atan2(RandomGpu y, RandomGpu x) {
    const double least = 0x1p-126, reach = rules().atan2_domain, far = std::abs(static_cast<double>(x.v));
    if (reach > 0 && (std::abs(static_cast<double>(y.v)) < least || far < 1 / reach || far > reach))
      return exactly(static_cast<float>(uniform(-4, 4)));
    const double height = y.v == 0 ? (toss() ? 0.0 : -0.0) : y.v;
    return exactly(perturbed(std::atan2(height, static_cast<double>(x.v)), rules().atan2));
  }
  friend RandomGpu fetch(const float* texels, Int offset, RandomGpu) { return exactly(texels[offset.i]); }

 private:
  static bool near_one(float x) { return 0.5f <= x && x <= 2; }
  static RandomGpu wave(double y, double x) {
    Accuracy a = rules().sin_cos;
    if (rules().sin_cos_domain > 0 && std::abs(x) > rules().sin_cos_domain)
      a.absolute = std::max(a.absolute, rules().sin_cos_beyond * std::abs(x));
    return exactly(std::clamp(perturbed(y, a, x), -1.0f, 1.0f));
  }
};

inline RandomGpu sum_any_order(RandomGpu a, RandomGpu b, RandomGpu c) {
  RandomGpu x[] = {a, b, c};
  std::shuffle(x, x + 3, words());
  return (x[0] + x[1]) + x[2];
}
inline RandomGpu sum_any_order(RandomGpu a, RandomGpu b, RandomGpu c, RandomGpu d) {
  RandomGpu x[] = {a, b, c, d};
  std::shuffle(x, x + 4, words());
  return toss() ? (x[0] + x[1]) + (x[2] + x[3]) : ((x[0] + x[1]) + x[2]) + x[3];
}
inline RandomGpu sum_any_order_in_pairs(RandomGpu a, RandomGpu b, RandomGpu c, RandomGpu d) { return sum_any_order(a, b, c, d); }
inline RandomGpu uniform_quotient(float a, float b, RandomGpu) { return RandomGpu(a) / RandomGpu(b); }
inline RandomGpu smoothstep(float edge0, float edge1, RandomGpu x) {
  const RandomGpu t = scalar::saturate((x - RandomGpu(edge0)) / (RandomGpu(edge1) - RandomGpu(edge0)));
  const RandomGpu slope = RandomGpu(3.0f) - RandomGpu(2.0f) * t;
  return toss() ? t * t * slope : t * (t * slope);
}
inline scalar::Vec3<RandomGpu> normalize(const scalar::Vec3<RandomGpu>& a) {
  const RandomGpu squared = scalar::dot(a, a);
  switch (words()() % 3) {
    case 0:
      return (RandomGpu(1.0f) / sqrt(squared)) * a;
    case 1:
      return {a.x / sqrt(squared), a.y / sqrt(squared), a.z / sqrt(squared)};
    default:
      return inverse_sqrt(squared) * a;
  }
}

}  // namespace rainref::random_gpu
