#include "math/perturbed.h"

#include <algorithm>
#include <array>

#include "math/constants.h"
#include "math/directed.h"
#include "math/perturbed_draws.h"

namespace rainref::perturbed {

constinit thread_local Behaviour detail::current;
constinit thread_local bool detail::is_nearest = true;
constinit thread_local bool detail::is_plain = true;
constinit thread_local bool detail::is_reference = true;

namespace {

using Reference = scalar::Scalar<float>;
using enclosed::Accuracy;
using enclosed::Profile;

using detail::current;
using detail::is_reference;

bool is(Fault fault) { return current.fault == fault; }
/// Whether this operation uses a variation that is allowed.
bool take(bool Variations::*variation) { return current.variations && current.variations->*variation && coin(); }
bool may_contract() { return current.variations && current.variations->rules.contraction && coin(); }
bool may_flush() { return current.variations && current.variations->rules.flush != enclosed::Flush::never && coin(); }
/// Whether an inexact result is rounded up or down, or left as it is.
bool may_round_to(bool up) {
  if (!current.variations || current.variations->rules.basic != enclosed::BasicRounding::either) return false;
  return current.lean != 0 && (draw() & 7) != 0 ? (current.lean > 0) == up : coin();
}

float beside(float x, bool up) {
  if (x == 0) return up ? 0x1p-149f : -0x1p-149f;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>((x > 0) == up ? bits + 1 : bits - 1);
}
bool subnormal(float x) { return x != 0 && x < 0x1p-126f && x > -0x1p-126f; }
float flushed(float x) {
  if (!subnormal(x)) return x;
  if (is(Fault::flushed) || may_flush()) return x < 0 ? -0.0f : 0.0f;
  return x;
}
/// Applies variations to a result: `nearest` is correctly rounded, `error` has the sign of exact - nearest.
Perturbed finish(float nearest, double error) {
  float r = nearest;
  if (error != 0 && may_round_to(error > 0)) r = beside(r, error > 0);
  if (is(Fault::half_intermediates)) r = to_float(to_half(r));
  return Perturbed::of(flushed(r));
}

double bound_of(double exact, const Accuracy& a, double x) {
  // Slightly less, to allow for the error of `exact` itself.
  return ((a.ulp + a.ulp_per_x * magnitude(x)) * enclosed::ulp_of(exact) + a.relative * magnitude(exact) + a.absolute) * (1 - 0x1p-20);
}
bool within(float r, double exact, double bound, const Accuracy& a) {
  const bool changes_sign = a.absolute == 0 && r != 0 && (r < 0) != (exact < 0);
  return magnitude(r - exact) <= bound && !changes_sign;
}
/// A function's value at x with a random error within the accuracy; `nearest` without variations, which need no exact_value().
template <class Exact>
Perturbed erring(float nearest, const Exact& exact_value, Accuracy Profile::*accuracy, double x = 0) {
  if (!current.variations) return finish(nearest, 0);
  const Accuracy& a = current.variations->rules.*accuracy;
  if (a.is_zero()) return finish(nearest, 0);
  const double exact = exact_value();
  const double bound = bound_of(exact, a, x);
  float r = static_cast<float>(exact + bound * swing());
  if (!within(r, exact, bound, a)) r = beside(r, r < exact);
  return finish(within(r, exact, bound, a) ? r : nearest, 0);
}

double exact(const Perturbed& a) { return a.v; }
Reference reference(const Perturbed& a) { return Reference(a.v); }

}  // namespace

Scope::Scope(const Behaviour& b) : saved_(current) { set(b); }
Scope::~Scope() { set(saved_); }
void Scope::set(const Behaviour& b) {
  current = b;
  detail::is_nearest = !b.variations && b.fault != Fault::fused && b.fault != Fault::flushed && b.fault != Fault::half_intermediates;
  detail::is_plain = detail::is_nearest && !b.follows() && b.fault != Fault::strict_for_weak && b.fault != Fault::weak_for_strict &&
                     b.fault != Fault::minimum_missing && b.fault != Fault::maximum_missing && b.fault != Fault::abs_missing;
  is_reference = detail::is_plain && b.fault == Fault::none && !b.constants && !b.loads && !b.coverage && b.column_offset == 0 &&
                 !b.is_column_mirrored;
}

void Perturbed::literal() {
  const float constant = v;
  if (current.constants) current.constants->push_back(constant);
  if (current.follows()) {
    const bool is_known = current.known && std::binary_search(current.known->begin(), current.known->end(), constant);
    leaf(Op::constant, is_known ? std::bit_cast<std::uint32_t>(constant) : 0);
  }
  if (is(Fault::constant)) {
    if (constant == current.constant) v = current.replacement;
    for (const auto& [made, instead] : current.derived)
      if (made != 0 && constant == made) v = instead;
  }
  if (is(Fault::half_constants)) v = to_float(to_half(constant));
}
Perturbed Perturbed::column(int first) {
  Perturbed column = of(current.is_column_mirrored ? current.column_offset - static_cast<float>(first)
                                                   : static_cast<float>(first) + current.column_offset);
  if (current.follows()) column.leaf(Op::index, 0);
  return column;
}
Perturbed Perturbed::load_of(const Perturbed& stored) {
  Perturbed texel = stored;
  if (current.loads && current.loaded < current.loads->size())
    if (const float other = (*current.loads)[current.loaded]; other == other) texel.v = other;
  ++current.loaded;
  if (current.follows()) texel.leaf(Op::load, 0);
  return texel;
}
Perturbed Perturbed::fetch_of(float texel) {
  Perturbed f = of(texel);
  if (current.follows()) f.leaf(Op::fetch, 0);
  return f;
}
Perturbed Perturbed::alone() const {
  Perturbed a;
  a.v = v;
  a.factor_ = factor_;
  a.other_ = other_;
  a.product_ = product_;
  return a;
}
Perturbed Perturbed::opposite() const {
  Perturbed o = alone();
  o.v = -o.v;
  o.factor_ = -o.factor_;
  return o;
}
bool Perturbed::is_less(const Perturbed& a, const Perturbed& b) {
  return Perturbed::met(is(Fault::weak_for_strict) ? a.v <= b.v : a.v < b.v, a, b);
}
bool Perturbed::is_at_most(const Perturbed& a, const Perturbed& b) {
  return Perturbed::met(is(Fault::strict_for_weak) ? a.v < b.v : a.v <= b.v, a, b);
}
Perturbed Perturbed::choice(bool m, const Perturbed& a, const Perturbed& b) {
  return Perturbed::made(
      Op::choice, [&] { return (m ? a : b).alone(); }, a, b, Perturbed::of(m ? 1.0f : 0.0f));
}
Perturbed Perturbed::minimum(const Perturbed& a, const Perturbed& b) {
  return Perturbed::made(
      Op::minimum, [&] { return Perturbed::of(is(Fault::minimum_missing) || !(b.v < a.v) ? a.v : b.v); }, a, b);
}
Perturbed Perturbed::maximum(const Perturbed& a, const Perturbed& b) {
  return Perturbed::made(
      Op::maximum, [&] { return Perturbed::of(is(Fault::maximum_missing) || !(a.v < b.v) ? a.v : b.v); }, a, b);
}
Perturbed abs(const Perturbed& a) {
  if (detail::is_plain) return Perturbed::of(a.v < 0 ? -a.v : a.v);
  return Perturbed::made(
      Op::magnitude, [&] { return a.v < 0 && !is(Fault::abs_missing) ? a.opposite() : a.alone(); }, a);
}
Perturbed Perturbed::negation(const Perturbed& a) {
  return Perturbed::made(
      Op::negation, [&] { return a.opposite(); }, a);
}
Perturbed Perturbed::sum(const Perturbed& a, const Perturbed& b) {
  return Perturbed::made(
      Op::sum, [&] { return detail::is_nearest ? of(a.v + b.v) : Perturbed::add(a, b); }, a, b);
}
Perturbed Perturbed::difference(const Perturbed& a, const Perturbed& b) {
  return Perturbed::made(
      Op::difference, [&] { return detail::is_nearest ? of(a.v - b.v) : Perturbed::add(a, b.opposite()); }, a, b);
}

Perturbed Perturbed::add(const Perturbed& a, const Perturbed& b) {
  if (a.product_ || b.product_) {
    if (is(Fault::fused) || may_contract()) {
      const bool first = a.product_ && !(b.product_ && take(&Variations::reorder));
      const Perturbed& p = first ? a : b;
      const double sum = enclosed::odd_sum(static_cast<double>(p.factor_) * p.other_, first ? b.v : a.v);
      const float nearest = static_cast<float>(sum);
      return finish(nearest, sum - nearest);
    }
  }
  const float s = a.v + b.v, t = s - a.v;
  return finish(s, (a.v - (s - t)) + (b.v - t));
}
Perturbed Perturbed::product(const Perturbed& a, const Perturbed& b) {
  const auto result = [&] {
    if (detail::is_nearest) return of(a.v * b.v);
    const float p = a.v * b.v;
    Perturbed r = finish(p, static_cast<double>(a.v) * b.v - p);
    r.factor_ = a.v;
    r.other_ = b.v;
    r.product_ = true;
    return r;
  };
  return Perturbed::made(Op::product, result, a, b);
}
Perturbed square(const Perturbed& a) {
  if (is_reference) return Perturbed::of(square(reference(a)).v);
  const auto squared = [&] {
    const Unseen parts;
    return is(Fault::square_missing) ? a : a * a;
  };
  return Perturbed::made(Op::square, squared, a);
}
namespace {
Perturbed divided(const Perturbed& a, const Perturbed& b) {
  if (is(Fault::reciprocal_division)) return finish(a.v * (1.0f / b.v), 0);
  if (is(Fault::division_by_estimate)) return finish(a.v * beside(1.0f / b.v, true), 0);
  const double exact_quotient = exact(a) / b.v;
  if (take(&Variations::reciprocal)) {
    const Accuracy& allowed = current.variations->rules.division;
    if (const float r = a.v * (1.0f / b.v); within(r, exact_quotient, bound_of(exact_quotient, allowed, 0), allowed)) return finish(r, 0);
  }
  return erring(
      a.v / b.v, [&] { return exact_quotient; }, &Profile::division);
}
}  // namespace
Perturbed Perturbed::quotient(const Perturbed& a, const Perturbed& b) {
  return Perturbed::made(
      Op::quotient, [&] { return divided(a, b); }, a, b);
}
Perturbed Perturbed::load_unorm(Unorm8 code) {
  if (is_reference) return of(scalar::to_float(code));
  // 0 and 1 are exact on every device.
  if (code.code == 0 || code.code == 255) return of(scalar::to_float(code));
  return erring(
      scalar::to_float(code), [&] { return code.code / 255.0; }, &Profile::unorm_load);
}
Perturbed inverse_sqrt(const Perturbed& a) {
  const double root = 1 / __builtin_sqrt(exact(a));
  return erring(
      static_cast<float>(root), [&] { return root; }, &Profile::inverse_sqrt);
}
Perturbed sqrt(const Perturbed& a) {
  if (is_reference) return Perturbed::of(sqrt(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    if (is(Fault::root_missing)) return a;
    if (is(Fault::root_by_inverse)) return a.v > 0 ? finish(1.0f / (1.0f / __builtin_sqrtf(a.v)), 0) : a;
    if (a.v == 0) return a;
    if (current.variations && current.variations->rules.sqrt_is_inherited) return Perturbed::of(1.0f) / inverse_sqrt(a);
    return erring(
        __builtin_sqrtf(a.v), [&] { return __builtin_sqrt(exact(a)); }, &Profile::sqrt);
  };
  return Perturbed::made(Op::root, result, a);
}
Perturbed floor(const Perturbed& a) {
  if (is_reference) return Perturbed::of(floor(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    const Reference down = floor(reference(a));
    if (is(Fault::truncated_floor)) return Perturbed::of(a.v < 0 && down.v != a.v ? down.v + 1 : down.v);
    if (is(Fault::rounded_floor)) return Perturbed::of(floor(Reference(a.v + 0.5f)).v);
    return Perturbed::of(down.v);
  };
  return Perturbed::made(Op::floor, result, a);
}
Perturbed fract(const Perturbed& a) {
  if (is_reference) return Perturbed::of(fract(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    const Reference down = floor(reference(a));
    if (is(Fault::fract_by_truncation) && a.v < 0) return finish(a.v - (down.v == a.v ? down.v : down.v + 1), 0);
    return a - Perturbed::of(down.v);
  };
  return Perturbed::made(Op::fract, result, a);
}
Perturbed mix(const Perturbed& a, const Perturbed& b, const Perturbed& t) {
  if (is_reference) return Perturbed::of(mix(reference(a), reference(b), reference(t)).v);
  const auto result = [&] {
    const Unseen parts;
    if (is(Fault::mix_swapped)) return b * (Perturbed::of(1.0f) - t) + a * t;
    if (is(Fault::mix_by_difference) || take(&Variations::mix_either)) return a + (b - a) * t;
    return a * (Perturbed::of(1.0f) - t) + b * t;
  };
  return Perturbed::made(Op::mix, result, a, b, t);
}

Perturbed exp(const Perturbed& a) {
  if (is_reference) return Perturbed::of(exp(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    if (is(Fault::exp_base_two)) return finish(exp2(reference(a)).v, 0);
    return erring(
        exp(reference(a)).v, [&] { return exp_real(Real64(exact(a))).v; }, &Profile::exp, exact(a));
  };
  return Perturbed::made(Op::exponential, result, a);
}
Perturbed exp2(const Perturbed& a) {
  if (is_reference) return Perturbed::of(exp2(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    if (is(Fault::exp2_base_e)) return finish(exp(reference(a)).v, 0);
    return erring(
        exp2(reference(a)).v, [&] { return exp2_real(Real64(exact(a))).v; }, &Profile::exp2, exact(a));
  };
  return Perturbed::made(Op::exponential2, result, a);
}
namespace {
bool near_one(const Perturbed& a) { return a.v >= 0.5f && a.v <= 2.0f; }
/// For variations only: a GPU's pow may be made of it.
Perturbed log2(const Perturbed& a) {
  const double y = coefficients::log2_e * log_real(Real64(exact(a))).v;
  return erring(
      static_cast<float>(y), [&] { return y; }, near_one(a) ? &Profile::log2_near_one : &Profile::log2);
}
constexpr double degree = 0x1.1df46a2529d39p-6;  // pi / 180
/// sin or cos, `exact` at x.
template <class Exact>
Perturbed wave(float nearest, const Exact& exact_value, double x) {
  if (!current.variations) return finish(nearest, 0);
  const Profile& p = current.variations->rules;
  Accuracy a = p.sin_cos;
  if (p.sin_cos_domain > 0 && magnitude(x) > p.sin_cos_domain) {
    if (p.sin_cos_beyond == 0) return Perturbed::of(static_cast<float>(swing()));
    a.absolute = std::max(a.absolute, p.sin_cos_beyond * magnitude(x));
  }
  const double exact = exact_value(), bound = bound_of(exact, a, x);
  const float r = static_cast<float>(std::clamp(exact + bound * swing(), -1.0, 1.0));
  return finish(within(r, exact, bound, a) ? r : nearest, 0);
}
}  // namespace
Perturbed log(const Perturbed& a) {
  if (is_reference) return Perturbed::of(log(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    return erring(
        log(reference(a)).v, [&] { return log_real(Real64(exact(a))).v; }, near_one(a) ? &Profile::log_near_one : &Profile::log);
  };
  return Perturbed::made(Op::logarithm, result, a);
}
Perturbed pow(const Perturbed& a, const Perturbed& b) {
  if (is_reference) return Perturbed::of(pow(reference(a), reference(b)).v);
  const auto result = [&] {
    const Unseen parts;
    if (is(Fault::pow_squared)) return a * a;
    if (current.variations && a.v > 0 && current.variations->rules.pow_is_inherited) return exp2(b * log2(a));
    const float nearest = pow(reference(a), reference(b)).v;
    const auto real = [&] { return pow_real(Real64(exact(a)), Real64(exact(b))).v; };
    return a.v > 0 ? erring(nearest, real, &Profile::pow) : finish(nearest, 0);
  };
  return Perturbed::made(Op::power, result, a, b);
}
Perturbed sin(const Perturbed& a) {
  if (is_reference) return Perturbed::of(sin(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    const double x = is(Fault::degrees) ? exact(a) * degree : exact(a);
    return wave(
        sin(Reference(static_cast<float>(x))).v, [&] { return sin_real(Real64(x)).v; }, x);
  };
  return Perturbed::made(Op::sine, result, a);
}
Perturbed cos(const Perturbed& a) {
  if (is_reference) return Perturbed::of(cos(reference(a)).v);
  const auto result = [&] {
    const Unseen parts;
    const double x = is(Fault::degrees) ? exact(a) * degree : exact(a);
    return wave(
        cos(Reference(static_cast<float>(x))).v, [&] { return cos_real(Real64(x)).v; }, x);
  };
  return Perturbed::made(Op::cosine, result, a);
}
Perturbed atan2(const Perturbed& given_y, const Perturbed& x) {
  if (is_reference) return Perturbed::of(atan2(reference(given_y), reference(x)).v);
  Perturbed y = given_y;
  const auto result = [&] {
    const Unseen parts;
    if (is(Fault::atan2_swapped)) return finish(atan2(reference(x), reference(y)).v, 0);
    if (current.variations && !enclosed::is_promised(current.variations->rules, y.v, x.v))
      return Perturbed::of(static_cast<float>(pi * swing()));
    // Some devices lose the sign of a zero.
    if (current.variations && y.v == 0) y.v = coin() ? 0.0f : -0.0f;
    return erring(
        atan2(reference(y), reference(x)).v, [&] { return atan2_real(Real64(exact(y)), Real64(exact(x))).v; }, &Profile::atan2);
  };
  return Perturbed::made(Op::angle, result, y, x);
}

namespace {
/// The terms in a random order.
template <std::size_t Count>
Perturbed shuffled_sum(std::array<Perturbed, Count> terms) {
  for (std::size_t i = Count - 1; i > 0; --i) std::swap(terms[i], terms[draw() % (i + 1)]);
  if (Count == 4 && coin()) return (terms[0] + terms[1]) + (terms[2] + terms[3]);
  Perturbed sum = terms[0];
  for (std::size_t i = 1; i < Count; ++i) sum = sum + terms[i];
  return sum;
}
}  // namespace
Perturbed sum_any_order(const Perturbed& a, const Perturbed& b, const Perturbed& c) {
  if (is_reference) return Perturbed::of(scalar::sum_any_order(reference(a), reference(b), reference(c)).v);
  if (is(Fault::sum_backwards)) return (c + b) + a;
  if (is(Fault::sum_otherwise_paired)) return a + (b + c);
  if (take(&Variations::reorder)) return shuffled_sum<3>({a, b, c});
  return (a + b) + c;
}
Perturbed sum_any_order(const Perturbed& a, const Perturbed& b, const Perturbed& c, const Perturbed& d) {
  if (is_reference) return Perturbed::of(scalar::sum_any_order(reference(a), reference(b), reference(c), reference(d)).v);
  if (is(Fault::sum_backwards)) return ((d + c) + b) + a;
  if (is(Fault::sum_otherwise_paired)) return (a + b) + (c + d);
  if (take(&Variations::reorder)) return shuffled_sum<4>({a, b, c, d});
  return ((a + b) + c) + d;
}
Perturbed sum_any_order_in_pairs(const Perturbed& a, const Perturbed& b, const Perturbed& c, const Perturbed& d) {
  if (is_reference) return Perturbed::of(scalar::sum_any_order_in_pairs(reference(a), reference(b), reference(c), reference(d)).v);
  if (is(Fault::sum_backwards)) return ((d + c) + b) + a;
  if (is(Fault::sum_otherwise_paired)) return (a + c) + (b + d);
  if (take(&Variations::reorder)) return shuffled_sum<4>({a, b, c, d});
  return (a + b) + (c + d);
}
namespace {

/// During its lifetime decisions belong to one that is already counted.
class Counted {
 public:
  Counted() : coverage_(current.coverage) { current.coverage = nullptr; }
  ~Counted() { current.coverage = coverage_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Coverage* coverage_;
};

}  // namespace

Perturbed clamp(const Perturbed& x, const Perturbed& low, const Perturbed& high, const Site& site) {
  if (is_reference) return scalar::clamp<Perturbed>(x, low, high);
  Perturbed::decided(site, DecisionKind::clamp, x.v < low.v ? 0 : x.v > high.v ? 2 : 1);
  const Counted parts;
  return scalar::clamp<Perturbed>(x, low, high);
}
Perturbed saturate(const Perturbed& x, const Site& site) {
  if (is_reference) return scalar::saturate<Perturbed>(x);
  Perturbed::decided(site, DecisionKind::clamp, x.v < 0 ? 0 : x.v > 1 ? 2 : 1);
  const Counted parts;
  return scalar::saturate<Perturbed>(x);
}
Perturbed smoothstep(float edge0, float edge1, const Perturbed& x, const Site& site) {
  if (is_reference) return scalar::smoothstep<Perturbed>(edge0, edge1, x);
  const float ramp = (x.v - edge0) / (edge1 - edge0);
  Perturbed::decided(site, DecisionKind::clamp, ramp < 0 ? 0 : ramp > 1 ? 2 : 1);
  const Counted counted;
  const auto result = [&]() -> Perturbed {
    const Unseen parts;
    if (is(Fault::smoothstep_linear)) return scalar::saturate((x - Perturbed(edge0)) / Perturbed(edge1 - edge0));
    if (!current.variations) return scalar::smoothstep<Perturbed>(edge0, edge1, x);
    // The edges' difference has the device's error.
    const Perturbed t = scalar::saturate((x - Perturbed(edge0)) / (Perturbed(edge1) - Perturbed(edge0)));
    const Perturbed slope = Perturbed(3.0f) - Perturbed(2.0f) * t;
    return take(&Variations::reorder) ? t * (t * slope) : t * t * slope;
  };
  if (!current.follows()) return result();
  const Perturbed from(edge0), to(edge1);
  return Perturbed::made(Op::smoothstep, result, x, from, to);
}
Perturbed uniform_quotient(float a, float b, Perturbed) { return current.variations ? Perturbed(a) / Perturbed(b) : Perturbed(a / b); }
scalar::Vec3<Perturbed> normalize(const scalar::Vec3<Perturbed>& a) {
  if (is_reference) return scalar::normalize<Perturbed>(a);
  if (is(Fault::normalize_missing)) return a;
  if (take(&Variations::normalize_any)) {
    const Perturbed squared = scalar::dot(a, a);
    if (coin()) return inverse_sqrt(squared) * a;
    const Perturbed length = sqrt(squared);
    return {a.x / length, a.y / length, a.z / length};
  }
  return scalar::normalize<Perturbed>(a);
}
/// Unchanged, or as a mistake changes it in this call alone.
scalar::Vec3<Perturbed> as_argument(const scalar::Vec3<Perturbed>& a) {
  const auto part = [](const Perturbed& x) { return Perturbed::met(Op::argument, x, x); };
  return {part(a.x), part(a.y), part(a.z)};
}
scalar::Vec3<Perturbed> reflect(const scalar::Vec3<Perturbed>& given_v, const scalar::Vec3<Perturbed>& given_n) {
  if (is_reference) return scalar::reflect<Perturbed>(given_v, given_n);
  const scalar::Vec3<Perturbed> v = as_argument(given_v), n = as_argument(given_n);
  if (is(Fault::reflect_doubled_missing)) return v - scalar::dot(n, v) * n;
  return scalar::reflect<Perturbed>(v, n);
}
scalar::Vec3<Perturbed> refract(const scalar::Vec3<Perturbed>& given_v, const scalar::Vec3<Perturbed>& given_n, float eta,
                                const Site& site) {
  if (is_reference) return scalar::refract<Perturbed>(given_v, given_n, eta);
  const scalar::Vec3<Perturbed> v = as_argument(given_v), n = as_argument(given_n);
  const float along = n.x.v * v.x.v + n.y.v * v.y.v + n.z.v * v.z.v;
  Perturbed::decided(site, DecisionKind::total_reflection, eta * eta * (1 - along * along) > 1);
  const auto bent = [&] {
    const Counted parts;
    return scalar::refract<Perturbed>(v, n, is(Fault::refract_ratio_inverted) ? 1.0f / eta : eta);
  }();
  const auto part = [](const Perturbed& after, const Perturbed& before) { return Perturbed::met(Op::bent, after, after, before); };
  return {part(bent.x, v.x), part(bent.y, v.y), part(bent.z, v.z)};
}
Perturbed nearest_octave(const Perturbed& x) {
  if (is_reference) return scalar::nearest_octave<Perturbed>(x);
  const Perturbed level = scalar::nearest_octave<Perturbed>(x);
  if (is(Fault::level_above)) return level + Perturbed(1.0f);
  if (is(Fault::level_below)) return scalar::nearest_octave<Perturbed>(x * Perturbed(0.5f));
  return level;
}

Variations variations_of(const Profile& p) {
  Variations all;
  all.rules = p;
  all.reorder = all.mix_either = all.reciprocal = all.normalize_any = !p.reference;
  return all;
}

}  // namespace rainref::perturbed
