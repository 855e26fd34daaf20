// The perturbed evaluation: one float, computed as some other machine or some fault of a porter would compute it.
//
// Two uses. A *fault* is one realistic mistake, taken everywhere in a pass: `mutate` asks whether it would be caught,
// the diagnosis whether it explains what a port did. *Variations* are what a conforming GPU may do, drawn at random: the
// envelopes are tested with them. Without either, a Perturbed is Scalar<float>, bit for bit.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "math/coverage.h"
#include "math/fixed_point_filter.h"
#include "math/places.h"
#include "math/scalar.h"
#include "math/profile.h"

namespace rainref::perturbed {

/// One mistake or one legal difference, made throughout a pass.
enum class Fault : std::uint8_t {
  none,
  // arithmetic that many GPUs do
  fused,
  reciprocal_division,
  root_by_inverse,
  flushed,
  mix_by_difference,
  sum_backwards,
  sum_otherwise_paired,
  division_by_estimate,
  // precision
  half_intermediates,
  half_constants,
  // decisions
  strict_for_weak,
  weak_for_strict,
  truncated_floor,
  rounded_floor,
  fract_by_truncation,
  minimum_missing,
  maximum_missing,
  abs_missing,
  // named mathematics
  normalize_missing,
  smoothstep_linear,
  root_missing,
  square_missing,
  refract_ratio_inverted,
  reflect_doubled_missing,
  exp_base_two,
  exp2_base_e,
  pow_squared,
  mix_swapped,
  atan2_swapped,
  degrees,
  // lookups
  address_clamped,
  address_repeated,
  address_mirrored,
  nearest_filter,
  weights_of_8_bits,
  half_texel_missing,
  half_texel_twice,
  texel_after,
  level_above,
  level_below,
  // a literal or a uniform of one value has another
  constant
};

/// Every fault but none and constant, in the order in which a diagnosis tries them.
inline std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (auto f = static_cast<int>(Fault::fused); f < static_cast<int>(Fault::constant); ++f) all.push_back(static_cast<Fault>(f));
  return all;
}

/// What a conforming machine may do, drawn at random at every operation: the accuracies, roundings, fusions and
/// samplers of a profile, and formulas that a profile does not name because every one of them allows them.
struct Variations {
  enclosed::Profile rules;
  bool reorder = false;        ///< sums in any order and grouping
  bool mix_either = false;     ///< a + (b - a) t too
  bool reciprocal = false;     ///< a (1 / b) where that lies within the division's error
  bool normalize_any = false;  ///< a / |a| and a inversesqrt(a . a) too
};
/// Exactly what the profile allows; nothing for one that is the reference.
Variations variations_of(const enclosed::Profile& profile);

/// Who makes filtered lookups, where no variation draws it.
enum class Filter : std::uint8_t {
  arithmetic,  ///< the pass text, in floats
  fixed_point  ///< a known device's sampler (fixed_point_filter.h)
};

/// What the calling thread's Perturbeds do.
struct Behaviour {
  Fault fault = Fault::none;
  Filter filter = Filter::arithmetic;
  float constant = 0, replacement = 0;  ///< of Fault::constant
  /// Numbers that a host or a compiler makes of the constant before the pass takes them, and what the replacement makes of them; the
  /// reciprocal first. 0: there is no such number.
  std::array<std::pair<float, float>, 5> derived{};
  const Variations* variations = nullptr;
  std::uint64_t random = 1;                 ///< state of the variations' draws
  int lean = 0;                             ///< -1 or 1: errors tend to this end, so that they add up
  std::vector<float>* constants = nullptr;  ///< collects every literal and uniform met

  // One mistake at one place, or at those that belong together: the coordinates of a lookup, the components of a vector.
  std::array<Place, 4> places{};
  const std::vector<float>* known = nullptr;  ///< sorted: constants that tell places apart; others are all alike
  Trace* trace = nullptr;                     ///< collects what is done
  Substitutions* substitutions = nullptr;     ///< other values for operands; start()ed before each invocation
  const std::vector<float>* loads = nullptr;  ///< what the texels loaded by integers are instead, in order
  std::size_t loaded = 0;                     ///< of these so far: 0 before each invocation
  std::uint64_t recent = 0;                   ///< the last ten operations, six bits each: 0 before each invocation
  float column_offset = 0;                    ///< added to the element's own column
  bool is_column_mirrored = false;            ///< the column is column_offset less itself instead
  bool reaches_all = false;                   ///< records that count at no texel nearby are met too: a mistake may change that
  Coverage* coverage = nullptr;               ///< counts which sides of decisions are taken
  /// What is counted in an invocation begins anew, and the values of before that rewrites look back to.
  void begin_invocation();
  bool follows() const { return trace || substitutions || places[0].fault != PlaceFault::none; }
};
namespace detail {
extern constinit thread_local Behaviour current;
/// Whether sums, products, comparisons and extrema are the reference's and nobody looks at them: what most invocations are made of.
extern constinit thread_local bool is_plain;
/// Whether everything is but lookups, for which Behaviour::filter counts.
extern constinit thread_local bool is_reference;
}  // namespace detail
inline Behaviour& behaviour() { return detail::current; }
/// A literal or a uniform of one value has another, and so has what is made of it alone: for a refractive index n the ratio 1 / n, its
/// squares, and the reflectance straight on. Only what has more digits than `constant` is taken for made of it.
Behaviour replacing(float constant, float by);
/// Sets the behaviour for a scope.
class Scope {
 public:
  explicit Scope(const Behaviour& b);
  ~Scope();
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  static void set(const Behaviour& b);

  Behaviour saved_;
};

/// Before each record of a list that a pass treats by itself: places are counted anew, as before each invocation. `look`: the record's
/// evaluation, made first where a value is taken from further on in it.
template <class Look>
void begin_record(const Look& look) {
  Behaviour& b = behaviour();
  b.begin_invocation();
  if (!b.substitutions || b.substitutions->is_looking) return;
  b.substitutions->start();
  b.substitutions->look_ahead(look);
  b.begin_invocation();
}

/// While it lives the calling thread's operations are none of the pass text: parts of a named one, or of a mistake.
class Unseen {
 public:
  Unseen();
  ~Unseen();
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;
};

class Perturbed {
 public:
  using Mask = bool;
  using Int = scalar::Index<Perturbed>;
  static constexpr int size() { return 1; }

  float v = 0;

  Perturbed() = default;
  Perturbed(float constant) : v(constant) {
    if (!detail::is_reference) literal();
  }
  /// A value that is no literal and no uniform.
  static Perturbed of(float x) {
    Perturbed d;
    d.v = x;
    return d;
  }
  template <class Storage>
  static Perturbed load(const Storage* p) {
    if constexpr (std::is_same_v<Storage, Unorm8>)
      return loaded(load_unorm(*p));
    else
      return loaded(of(scalar::to_float(*p)));
  }
  static Perturbed index(int first) { return detail::is_reference ? of(static_cast<float>(first)) : column(first); }
  static Int uniform_int(int value) { return {value}; }

  friend Perturbed operator+(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? of(a.v + b.v) : sum(a, b); }
  friend Perturbed operator-(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? of(a.v - b.v) : difference(a, b); }
  friend Perturbed operator*(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? of(a.v * b.v) : product(a, b); }
  friend Perturbed operator/(const Perturbed& a, const Perturbed& b) { return detail::is_reference ? of(a.v / b.v) : quotient(a, b); }
  friend Perturbed operator-(const Perturbed& a) { return detail::is_plain ? of(-a.v) : negation(a); }
  friend bool operator<(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? a.v < b.v : is_less(a, b); }
  friend bool operator<=(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? a.v <= b.v : is_at_most(a, b); }
  friend bool operator>(const Perturbed& a, const Perturbed& b) { return b < a; }
  friend bool operator>=(const Perturbed& a, const Perturbed& b) { return b <= a; }
  // The place of the call is that of a decision in the pass text.
  friend Perturbed select(bool m, const Perturbed& a, const Perturbed& b, const Site& site = Site::here()) {
    decided(site, DecisionKind::choice, !m);
    return chosen(m, a, b);
  }
  friend Perturbed min(const Perturbed& a, const Perturbed& b, const Site& site = Site::here()) {
    decided(site, DecisionKind::minimum, b.v < a.v);
    return lesser(a, b);
  }
  friend Perturbed max(const Perturbed& a, const Perturbed& b, const Site& site = Site::here()) {
    decided(site, DecisionKind::maximum, a.v < b.v);
    return greater(a, b);
  }
  friend Perturbed abs(const Perturbed& a);
  friend Perturbed sqrt(const Perturbed& a);
  friend Perturbed square(const Perturbed& a);
  friend Perturbed floor(const Perturbed& a);
  friend Perturbed fract(const Perturbed& a);
  friend Perturbed mix(const Perturbed& a, const Perturbed& b, const Perturbed& t);
  /// A number that a fault has made too large for an integer is cut.
  friend Int to_int(const Perturbed& a) { return {a.v > -0x1p30f && a.v < 0x1p30f ? static_cast<std::int32_t>(a.v) : 0}; }
  friend Perturbed to_number(Int a) { return of(static_cast<float>(a.i)); }
  friend Perturbed fetch(const float* texels, Int offset, Perturbed) {
    if (behaviour().coverage) behaviour().coverage->fetched(texels);
    return fetched(texels[offset.i]);
  }

  friend Perturbed exp(const Perturbed& a);
  friend Perturbed exp2(const Perturbed& a);
  friend Perturbed log(const Perturbed& a);
  friend Perturbed pow(const Perturbed& a, const Perturbed& b);
  friend Perturbed sin(const Perturbed& a);
  friend Perturbed cos(const Perturbed& a);
  friend Perturbed atan2(const Perturbed& y, const Perturbed& x);

  /// 1 / sqrt(a) in one instruction: passes do not name it, variations do.
  friend Perturbed inverse_sqrt(const Perturbed& a);

  /// The result of an operation of the pass text: as it is, or as the mistake at this place has it.
  template <class... Operands>
  static Perturbed met(Op op, const Perturbed& result, const Operands&... of) {
    return behaviour().follows() ? follow(op, result, {&of...}) : result;
  }
  /// The same of what `result` makes: made where it is returned to, for a copy waits until all of it is written.
  template <class Result, class... Operands>
  static Perturbed made(Op op, const Result& result, const Operands&... of) {
    Perturbed r = result();
    if (behaviour().follows()) r = follow(op, r, {&of...});
    return r;
  }
  static bool met(bool result, const Perturbed& a, const Perturbed& b) { return behaviour().follows() ? follow(result, a, b) : result; }

  static bool meets_all() { return behaviour().reaches_all; }
  /// What a result is given: a place of its own, where something else may stand than where the same value counts otherwise.
  Perturbed as_stored() const { return met(Op::stored, *this, *this); }

  /// Its place in Behaviour::trace; -1: none.
  std::int32_t node() const { return node_; }

  /// Counts a side of a decision of the pass text, where that is asked for.
  static void decided(const Site& site, DecisionKind kind, int side) {
    if (behaviour().coverage) behaviour().coverage->met(site, kind, side);
  }
  /// The decision counted last is one of a guard() of the pass vocabulary; side: -1, or the one end of a clamp that it speaks of.
  static void guarded(const char* reason, int side = -1) {
    if (behaviour().coverage) behaviour().coverage->guarded(reason, side);
  }

 private:
  // As the behaviour has them.
  void literal();
  static Perturbed column(int first);
  static Perturbed sum(const Perturbed& a, const Perturbed& b);
  static Perturbed difference(const Perturbed& a, const Perturbed& b);
  static Perturbed product(const Perturbed& a, const Perturbed& b);
  static Perturbed quotient(const Perturbed& a, const Perturbed& b);
  static Perturbed negation(const Perturbed& a);
  static bool is_less(const Perturbed& a, const Perturbed& b);
  static bool is_at_most(const Perturbed& a, const Perturbed& b);
  static Perturbed chosen(bool m, const Perturbed& a, const Perturbed& b) { return detail::is_plain ? of(m ? a.v : b.v) : choice(m, a, b); }
  static Perturbed choice(bool m, const Perturbed& a, const Perturbed& b);
  static Perturbed lesser(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? of(b.v < a.v ? b.v : a.v) : minimum(a, b); }
  static Perturbed minimum(const Perturbed& a, const Perturbed& b);
  static Perturbed greater(const Perturbed& a, const Perturbed& b) { return detail::is_plain ? of(a.v < b.v ? b.v : a.v) : maximum(a, b); }
  static Perturbed maximum(const Perturbed& a, const Perturbed& b);
  static Perturbed add(const Perturbed& a, const Perturbed& b);
  static Perturbed load_unorm(Unorm8 code);
  static Perturbed loaded(const Perturbed& texel) { return detail::is_reference ? texel : load_of(texel); }
  static Perturbed load_of(const Perturbed& texel);
  static Perturbed fetched(float texel) { return detail::is_reference ? of(texel) : fetch_of(texel); }
  static Perturbed fetch_of(float texel);
  void leaf(Op op, std::uint32_t shape);
  static Perturbed follow(Op op, const Perturbed& result, std::initializer_list<const Perturbed*> of);
  static bool follow(bool result, const Perturbed& a, const Perturbed& b);
  static Perturbed with_fault(Op op, const Perturbed& result, std::initializer_list<const Perturbed*> of, PlaceFault fault);
  Perturbed opposite() const;

  // A product that the next addition may fuse: v = factor_ times other_, rounded.
  float factor_ = 0, other_ = 0;
  bool product_ = false;
  // Where it comes from, while places are followed: hashes one, two and three operations deep, and its node of the trace.
  std::array<std::uint32_t, 3> shape_{};
  std::int32_t node_ = -1;
};

// Found by argument before the vocabulary's templates.
Perturbed sum_any_order(const Perturbed& a, const Perturbed& b, const Perturbed& c);
Perturbed sum_any_order(const Perturbed& a, const Perturbed& b, const Perturbed& c, const Perturbed& d);
Perturbed sum_any_order_in_pairs(const Perturbed& a, const Perturbed& b, const Perturbed& c, const Perturbed& d);
Perturbed clamp(const Perturbed& x, const Perturbed& low, const Perturbed& high, const Site& site = Site::here());
Perturbed saturate(const Perturbed& x, const Site& site = Site::here());
Perturbed smoothstep(float edge0, float edge1, const Perturbed& x, const Site& site = Site::here());
inline scalar::Vec3<Perturbed> select(bool m, const scalar::Vec3<Perturbed>& a, const scalar::Vec3<Perturbed>& b,
                                      const Site& site = Site::here()) {
  return {select(m, a.x, b.x, site), select(m, a.y, b.y, site), select(m, a.z, b.z, site)};
}
scalar::Vec3<Perturbed> normalize(const scalar::Vec3<Perturbed>& a);
scalar::Vec3<Perturbed> reflect(const scalar::Vec3<Perturbed>& v, const scalar::Vec3<Perturbed>& n);
scalar::Vec3<Perturbed> refract(const scalar::Vec3<Perturbed>& v, const scalar::Vec3<Perturbed>& n, float eta,
                                const Site& site = Site::here());
Perturbed nearest_octave(const Perturbed& x);
inline Perturbed whole_coordinate(const Perturbed& x) { return Perturbed::met(Op::coordinate, x, x); }
Perturbed uniform_quotient(float a, float b, Perturbed);

/// While a lookup between two levels is made whose weights are rounded together: the share of the level at hand.
struct Share {
  float of_level = 0;  ///< 0: no such lookup
  bool x_first = true;
};
Share& share();

/// One lookup by a sampler or by arithmetic, as the variations have it: what it takes for a normalized coordinate, for
/// one in texels, and for a level of detail.
struct Sampler {
  Sampler();
  bool is_used;
  float coordinate(float u) const;
  float texel(float x) const;
  float level(float lod) const;
  /// The filtered value of texels a, b, c, d, `in_float` by arithmetic: the four weights rounded so that rows and columns
  /// keep their sums, the result to numbers of so many bits (24: floats, 11: halves, 0: codes of 8 bits).
  float blend(float in_float, float a, float b, float c, float d, bool inside_cell, int bits) const;

  /// Whether this lookup between two levels rounds all eight weights together, the level's share in them: each level is then
  /// weighted(), with x or y first, and their sum stored().
  bool rounds_jointly() const;
  bool takes_x_first() const;
  float weighted(float a, float b, float c, float d, float fx, float fy, float share, bool x_first) const;
  float stored(float value, int bits) const;

 private:
  bool is_fixed_point;
};

}  // namespace rainref::perturbed
