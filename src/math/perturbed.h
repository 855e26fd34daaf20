// The perturbed evaluation: one float, computed as another machine would, or a port with a mistake.
//
// It has two uses. A *fault* is one realistic mistake, made everywhere in a pass: `mutate` tests whether it would be caught, the diagnosis
// whether it explains the results of a port. *Variations* are random differences that a conforming GPU may have; the envelopes are tested
// with them. Without either, a Perturbed equals Scalar<float> bit for bit.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "math/coverage.h"
#include "math/fixed_point_filter.h"
#include "math/trace.h"
#include "math/scalar.h"
#include "math/profile.h"

namespace rainref::perturbed {

/// One mistake or one permitted difference, made throughout a pass.
enum class Fault : std::uint8_t {
  none,
  // arithmetic of many GPUs
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
  // a literal or a uniform of one value is replaced
  constant
};

/// Every fault except none and constant, in the order in which a diagnosis tries them.
inline std::vector<Fault> faults() {
  std::vector<Fault> all;
  for (auto f = static_cast<int>(Fault::fused); f < static_cast<int>(Fault::constant); ++f) all.push_back(static_cast<Fault>(f));
  return all;
}

/// Random differences that a conforming machine may have at each operation: the accuracies, roundings, fusions and samplers of a profile,
/// and formulas that every profile allows.
struct Variations {
  enclosed::Profile rules;
  bool reorder = false;        ///< sums in any order and grouping
  bool mix_either = false;     ///< also a + (b - a) t
  bool reciprocal = false;     ///< a (1 / b) if that lies within the division's error
  bool normalize_any = false;  ///< also a / |a| and a inversesqrt(a . a)
};
/// Exactly what the profile allows; none for the reference profile.
Variations variations_of(const enclosed::Profile& profile);

/// How filtered lookups are computed if no variation draws it.
enum class Filter : std::uint8_t {
  arithmetic,  ///< by the pass text, in floats
  fixed_point  ///< by a known device's sampler (fixed_point_filter.h)
};

/// How the Perturbeds of the calling thread behave.
struct Behaviour {
  Fault fault = Fault::none;
  Filter filter = Filter::arithmetic;
  float constant = 0, replacement = 0;  ///< for Fault::constant
  /// Numbers that a host or a compiler derives from the constant, each with its replacement; the reciprocal first. 0: there is no such
  /// number.
  std::array<std::pair<float, float>, 5> derived{};
  const Variations* variations = nullptr;
  std::uint64_t random = 1;                 ///< state of the random draws of the variations
  int lean = 0;                             ///< -1 or 1: errors tend to this end, so that they add up; 0: no tendency
  std::vector<float>* constants = nullptr;  ///< collects every literal and uniform met

  // One mistake at one place, or at places that belong together: the coordinates of a lookup, the components of a vector. A place without a
  // fault ends the list. If the first place is by_sequence, so are the others.
  std::array<Place, 4> places{};
  const std::vector<float>* known = nullptr;  ///< sorted: constants that distinguish places; all other constants are treated as equal
  Trace* trace = nullptr;                     ///< collects the operations
  Substitutions* substitutions = nullptr;     ///< other values for operands; call start() before each invocation
  const std::vector<float>* loads = nullptr;  ///< values that replace texels loaded by integers, in order
  std::size_t loaded = 0;                     ///< number used so far: 0 before each invocation
  std::uint64_t recent = 0;                   ///< the last ten operations, six bits each: 0 before each invocation
  float column_offset = 0;                    ///< added to the element's own column
  bool is_column_mirrored = false;            ///< the column is column_offset minus itself instead
  bool reaches_all = false;                   ///< records that count at no nearby texel are also evaluated, because a mistake may change
                                              ///< that
  Coverage* coverage = nullptr;               ///< counts the sides of decisions that are taken
  /// Resets the counts of an invocation, and the earlier values that rewrites refer to.
  void begin_invocation();
  bool follows() const { return trace || substitutions || places[0].fault != PlaceFault::none; }
};
namespace detail {
extern constinit thread_local Behaviour current;
/// True if sums and products are the reference's.
extern constinit thread_local bool is_nearest;
/// True if comparisons and extrema are too and nothing observes any of them, which holds for most invocations.
extern constinit thread_local bool is_plain;
/// True if everything is the reference's except lookups, which use Behaviour::filter.
extern constinit thread_local bool is_reference;
}  // namespace detail
inline Behaviour& behaviour() { return detail::current; }
/// A literal or a uniform of one value is replaced, and so are values derived from it alone: for a refractive index n the ratio 1 / n, its
/// squares, and the reflectance at normal incidence. A value counts as derived only if it has more digits than `constant`.
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

/// Call before each record of a list that a pass treats separately: places are counted anew, as before each invocation. `look`: the
/// evaluation of the record, made first if a value is taken from a later point of it.
template <class Look>
void begin_record(const Look& look) {
  Behaviour& b = behaviour();
  b.begin_invocation();
  if (!b.substitutions || b.substitutions->is_looking) return;
  b.substitutions->start();
  b.substitutions->look_ahead(look);
  b.begin_invocation();
}

/// During its lifetime the calling thread's operations do not belong to the pass text, because they are parts of a named function or of a
/// mistake.
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
  /// A value that is neither a literal nor a uniform.
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
  // The position of the call is the position of the decision in the pass text.
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
  /// A number that a fault has made too large for an integer is truncated.
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

  /// 1 / sqrt(a) as one instruction; used by variations, not by passes.
  friend Perturbed inverse_sqrt(const Perturbed& a);

  /// The result of an operation of the pass text: unchanged, or as the mistake at this place changes it.
  template <class... Operands>
  static Perturbed met(Op op, const Perturbed& result, const Operands&... of) {
    Perturbed r = result;
    if (behaviour().follows()) follow(op, r, {&of...});
    return r;
  }
  /// The same for the value of `result`, constructed in place, because a copy would wait until all of it is written.
  template <class Result, class... Operands>
  static Perturbed made(Op op, const Result& result, const Operands&... of) {
    Perturbed r = result();
    if (behaviour().follows()) follow(op, r, {&of...});
    return r;
  }
  static bool met(bool result, const Perturbed& a, const Perturbed& b) { return behaviour().follows() ? follow(result, a, b) : result; }

  static bool meets_all() { return behaviour().reaches_all; }
  /// A stored result: a separate place, so that another value may be stored than is used elsewhere.
  Perturbed as_stored() const { return met(Op::stored, *this, *this); }

  /// Its node in Behaviour::trace; -1: none.
  std::int32_t node() const { return node_; }

  /// Counts a side of a decision of the pass text, if coverage is recorded.
  static void decided(const Site& site, DecisionKind kind, int side) {
    if (behaviour().coverage) behaviour().coverage->met(site, kind, side);
  }
  /// The last counted decision belongs to a guard() of the pass vocabulary; side: -1, or the one end of a clamp that it refers to.
  static void guarded(const char* reason, int side = -1) {
    if (behaviour().coverage) behaviour().coverage->guarded(reason, side);
  }

 private:
  // Applies the behaviour to a literal.
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
  /// Changes the result of an operation in place.
  static void follow(Op op, Perturbed& result, std::initializer_list<const Perturbed*> of);
  static bool follow(bool result, const Perturbed& a, const Perturbed& b);
  static Perturbed with_fault(Op op, const Perturbed& result, std::initializer_list<const Perturbed*> of, PlaceFault fault);
  /// Its number without its origin. Copied part by part: a copy of the whole would wait until all of it is written.
  Perturbed alone() const;
  Perturbed opposite() const;

  // A product that the next addition may fuse: v = factor_ times other_, rounded.
  float factor_ = 0, other_ = 0;
  bool product_ = false;
  // Its origin, while places are tracked: hashes one, two and three operations deep, and its node in the trace.
  std::array<std::uint32_t, 3> shape_{};
  std::int32_t node_ = -1;
};

// Argument-dependent lookup finds this before the vocabulary's templates.
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

/// During a lookup between two levels whose weights are rounded together: the share of the current level.
struct Share {
  float of_level = 0;  ///< 0: no such lookup
  bool x_first = true;
};
Share& share();

/// One lookup by a sampler or by arithmetic, as the variations choose: its normalized coordinate, its coordinate in texels, and its level
/// of detail.
struct Sampler {
  Sampler();
  bool is_used;
  float coordinate(float u) const;
  float texel(float x) const;
  float level(float lod) const;
  /// The filtered value of texels a, b, c, d, with `in_float` by arithmetic: the four weights are rounded so that rows and columns keep
  /// their sums, and the result is rounded to numbers of `bits` bits (24: floats, 11: halves, 0: 8-bit codes).
  float blend(float in_float, float a, float b, float c, float d, bool inside_cell, int bits) const;

  /// Whether this lookup between two levels rounds all eight weights together, including the level's share. Each level is then weighted(),
  /// with x or y first, and their sum stored().
  bool rounds_jointly() const;
  bool takes_x_first() const;
  float weighted(float a, float b, float c, float d, float fx, float fy, float share, bool x_first) const;
  float stored(float value, int bits) const;

 private:
  bool is_fixed_point;
};

}  // namespace rainref::perturbed
