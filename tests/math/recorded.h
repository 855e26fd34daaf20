// A number that records how it was computed, as a tree for rewriter.h: what a pass's text says, invocation by invocation. Decisions are
// those of the reference; lookups give what the reference gives.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/scalar.h"
#include "math/rewriter.h"
#include "rainref/texture.h"

namespace rainref::test {

/// The leaves of the trees that are being recorded.
inline std::vector<float>& recorded_values() {
  static std::vector<float> values;
  return values;
}

struct Recorded {
  using Single = scalar::Scalar<float>;
  using Gpu = random_gpu::RandomGpu;
  using Mask = bool;
  using Int = scalar::Index<Recorded>;
  static constexpr int size() { return 1; }

  float v = 0;
  Tree tree;
  bool is_looked_up = false;  ///< what a sampler gave: no arithmetic of a compiler's

  Recorded() : Recorded(0.0f) {}
  Recorded(float x) : v(x), tree(leaf_of(static_cast<int>(recorded_values().size()))) { recorded_values().push_back(x); }
  Recorded(float x, Tree t) : v(x), tree(std::move(t)) {}
  template <class Storage>
  static Recorded load(const Storage* p) {
    return Recorded(scalar::to_float(*p));
  }
  static Recorded index(int first) { return Recorded(static_cast<float>(first)); }
  static Int uniform_int(int value) { return {value}; }

  friend Recorded operator+(const Recorded& a, const Recorded& b) { return {a.v + b.v, of(Node::sum, {a.tree, b.tree})}; }
  friend Recorded operator-(const Recorded& a) {
    if (a.tree->kind == Node::leaf) return {-a.v, leaf_of(a.tree->index, !a.tree->negative)};
    return {-a.v, of(Node::product, {Recorded(-1.0f).tree, a.tree})};
  }
  friend Recorded operator-(const Recorded& a, const Recorded& b) { return {a.v - b.v, (a + -b).tree}; }
  friend Recorded operator*(const Recorded& a, const Recorded& b) { return {a.v * b.v, of(Node::product, {a.tree, b.tree})}; }
  /// A division, or a product with the reciprocal.
  friend Recorded operator/(const Recorded& a, const Recorded& b) {
    if (random_gpu::toss()) return {a.v / b.v, applied([](const Gpu* x) { return x[0] / x[1]; }, {a.tree, b.tree})};
    return {a.v / b.v, of(Node::product, {a.tree, applied([](const Gpu* x) { return Gpu(1.0f) / x[0]; }, {b.tree})})};
  }
  friend Recorded square(const Recorded& a) { return a * a; }
  friend bool operator<(const Recorded& a, const Recorded& b) { return a.v < b.v; }
  friend bool operator<=(const Recorded& a, const Recorded& b) { return a.v <= b.v; }
  friend bool operator>(const Recorded& a, const Recorded& b) { return a.v > b.v; }
  friend bool operator>=(const Recorded& a, const Recorded& b) { return a.v >= b.v; }
  friend Recorded select(bool m, const Recorded& a, const Recorded& b) { return m ? a : b; }
  static Recorded looked_up(float x) {
    Recorded r(x);
    r.is_looked_up = true;
    return r;
  }
  friend Recorded mix(const Recorded& a, const Recorded& b, const Recorded& t) {
    const float v = mix(Single(a.v), Single(b.v), Single(t.v)).v;
    if (a.is_looked_up && b.is_looked_up && t.tree->kind == Node::leaf) return looked_up(v);  // between two levels
    return {v, random_gpu::toss() ? (a * (Recorded(1.0f) - t) + b * t).tree : (a + (b - a) * t).tree};
  }
  /// Which integer it is was decided.
  friend Recorded floor(const Recorded& a) { return Recorded(floor(Single(a.v)).v); }
  friend Recorded fract(const Recorded& a) { return a - floor(a); }
  friend Int to_int(const Recorded& a) { return {to_int(Single(a.v)).i}; }
  friend Recorded to_number(Int a) { return index(a.i); }
  /// What a pass rounds on its way, as the reference stores it.
  friend Recorded half_of(const Recorded& a, Rounding own) {
    const auto nearest = [](const Gpu* x) { return Gpu(to_float(to_half(x[0].v, Rounding::rne))); };
    const auto toward_zero = [](const Gpu* x) { return Gpu(to_float(to_half(x[0].v, Rounding::rtz))); };
    const float stored = to_float(to_half(a.v, own));
    return {stored, own == Rounding::rne ? applied(nearest, {a.tree}) : applied(toward_zero, {a.tree})};
  }
  friend Recorded fetch(const float* texels, Int offset, const Recorded&) { return Recorded(texels[offset.i]); }

#define RAINREF_RECORDED_1(name)                                                              \
  friend Recorded name(const Recorded& a) {                                                   \
    return {name(Single(a.v)).v, applied([](const Gpu* x) { return name(x[0]); }, {a.tree})}; \
  }
#define RAINREF_RECORDED_2(name)                                                                                         \
  friend Recorded name(const Recorded& a, const Recorded& b) {                                                           \
    return {name(Single(a.v), Single(b.v)).v, applied([](const Gpu* x) { return name(x[0], x[1]); }, {a.tree, b.tree})}; \
  }
  RAINREF_RECORDED_1(abs)
  RAINREF_RECORDED_1(sqrt)
  RAINREF_RECORDED_1(exp)
  RAINREF_RECORDED_1(exp2)
  RAINREF_RECORDED_1(log)
  RAINREF_RECORDED_1(sin)
  RAINREF_RECORDED_1(cos)
  RAINREF_RECORDED_2(min)
  RAINREF_RECORDED_2(max)
  RAINREF_RECORDED_2(pow)
  RAINREF_RECORDED_2(atan2)
#undef RAINREF_RECORDED_1
#undef RAINREF_RECORDED_2
};

/// A built-in: a function of its arguments.
inline scalar::Vec3<Recorded> normalize(const scalar::Vec3<Recorded>& a) {
  using Gpu = random_gpu::RandomGpu;
  using Single = scalar::Scalar<float>;
  const auto n = scalar::normalize(scalar::Vec3<Single>(Single(a.x.v), Single(a.y.v), Single(a.z.v)));
  return {Recorded(n.x.v,
                   applied([](const Gpu* x) { return normalize(scalar::Vec3<Gpu>(x[0], x[1], x[2])).x; }, {a.x.tree, a.y.tree, a.z.tree})),
          Recorded(n.y.v,
                   applied([](const Gpu* x) { return normalize(scalar::Vec3<Gpu>(x[0], x[1], x[2])).y; }, {a.x.tree, a.y.tree, a.z.tree})),
          Recorded(n.z.v,
                   applied([](const Gpu* x) { return normalize(scalar::Vec3<Gpu>(x[0], x[1], x[2])).z; }, {a.x.tree, a.y.tree, a.z.tree}))};
}

// Where a sampler looks and how it weighs is decided as the reference does.
inline Recorded texel_coordinate(Address address, const Recorded& u, const Recorded& size) {
  using Single = scalar::Scalar<float>;
  const float w = size.v;
  const auto held = [](float x, float low, float high) { return std::min(std::max(x, low), high); };
  const float half_turn = fract(Single(u.v * 0.5f)).v;
  switch (address) {
    case Address::repeat:
      return Recorded(fract(Single(u.v)).v * w - 0.5f);
    case Address::mirror:
      return Recorded(held((1.0f - std::abs(2.0f * half_turn - 1.0f)) * w - 0.5f, 0.0f, w - 1.0f));
    case Address::border:
      return Recorded(held(u.v * w - 0.5f, -1.0f, w));
    default:
      return Recorded(held(u.v * w - 0.5f, 0.0f, w - 1.0f));
  }
}
inline Recorded level_of_detail(const Recorded& lod) { return Recorded(lod.v); }
inline Recorded blend(TexelPrecision, const Recorded& a, const Recorded& b, const Recorded& c, const Recorded& d, const Recorded& fx,
                      const Recorded& fy) {
  using Single = scalar::Scalar<float>;
  const Single x(fx.v), y(fy.v);
  return Recorded::looked_up(mix(mix(Single(a.v), Single(b.v), x), mix(Single(c.v), Single(d.v), x), y).v);
}

}  // namespace rainref::test
