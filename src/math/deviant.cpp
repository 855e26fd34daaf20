#include "math/deviant.h"

#include <algorithm>
#include <array>

#include "math/directed.h"

namespace rainref::deviant {
namespace {

using Reference = plain::Plain<float>;
using enclosed::Accuracy;
using enclosed::Profile;

thread_local Behaviour current;

/// splitmix64 (Steele, Lea, Flood 2014): draws of the liberties only.
std::uint64_t draw() {
  std::uint64_t z = current.random += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}
bool coin() { return draw() & 1; }
/// In [-1, 1), or often an end.
double swing() {
  const std::uint64_t bits = draw();
  if (current.lean != 0 && (bits & 14) != 0) return current.lean;
  if (bits & 1) return bits & 2 ? 1 : -1;
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

bool is(Slip slip) { return current.slip == slip; }
/// Whether this operation takes a liberty that is granted.
bool take(bool Liberties::*liberty) { return current.liberties && current.liberties->*liberty && coin(); }
bool may_contract() { return current.liberties && current.liberties->rules.contraction && coin(); }
bool may_flush() { return current.liberties && current.liberties->rules.flush != enclosed::Flush::never && coin(); }
/// Up, down, or as it is: which neighbour of an inexact result.
bool may_round_to(bool up) {
  if (!current.liberties || current.liberties->rules.basic != enclosed::BasicRounding::either) return false;
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
  if (is(Slip::flushed) || may_flush()) return x < 0 ? -0.0f : 0.0f;
  return x;
}
/// What happens to every result: `nearest` is it correctly rounded, `error` has the sign of exact - nearest.
Deviant finish(float nearest, double error) {
  float r = nearest;
  if (error != 0 && may_round_to(error > 0)) r = beside(r, error > 0);
  if (is(Slip::half_intermediates)) r = to_float(to_half(r));
  return Deviant::of(flushed(r));
}
double magnitude(double x) { return x < 0 ? -x : x; }
double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52); }

double bound_of(double exact, const Accuracy& a, double x) {
  // A little less, for what `exact` itself is off by.
  return ((a.ulp + a.ulp_per_x * magnitude(x)) * enclosed::ulp_of(exact) + a.relative * magnitude(exact) + a.absolute) * (1 - 0x1p-20);
}
bool within(float r, double exact, double bound, const Accuracy& a) {
  const bool changes_sign = a.absolute == 0 && r != 0 && (r < 0) != (exact < 0);
  return magnitude(r - exact) <= bound && !changes_sign;
}
/// A function's value at x with a random error that the accuracy allows; `nearest` without liberties.
Deviant erring(float nearest, double exact, Accuracy Profile::*accuracy, double x = 0) {
  if (!current.liberties) return finish(nearest, 0);
  const Accuracy& a = current.liberties->rules.*accuracy;
  if (a.is_zero()) return finish(nearest, 0);
  const double bound = bound_of(exact, a, x);
  float r = static_cast<float>(exact + bound * swing());
  if (!within(r, exact, bound, a)) r = beside(r, r < exact);
  return finish(within(r, exact, bound, a) ? r : nearest, 0);
}

/// a b + c, made odd where inexact: it rounds to float as the exact value would (Boldo and Melquiond, Emulation of FMA,
/// 2008).
double odd_sum_of_product(float a, float b, float c) {
  const double p = static_cast<double>(a) * b, s = p + c, t = s - p, error = (p - (s - t)) + (c - t);
  if (error == 0 || s == 0) return s;
  auto bits = std::bit_cast<std::uint64_t>(s);
  if (!(bits & 1)) bits = (error > 0) == (s > 0) ? bits + 1 : bits - 1;
  return std::bit_cast<double>(bits);
}
double exact(const Deviant& a) { return a.v; }
Reference reference(const Deviant& a) { return Reference(a.v); }

}  // namespace

Behaviour& behaviour() { return current; }

Deviant::Deviant(float constant) : v(constant) {
  if (current.constants) current.constants->push_back(constant);
  if (is(Slip::constant) && constant == current.constant) v = current.replacement;
  if (is(Slip::half_constants)) v = to_float(to_half(constant));
}

Deviant Deviant::add(Deviant a, Deviant b) {
  if (a.product_ || b.product_) {
    if (is(Slip::fused) || may_contract()) {
      const bool first = a.product_ && !(b.product_ && take(&Liberties::reorder));
      const Deviant& p = first ? a : b;
      const double sum = odd_sum_of_product(p.factor_, p.other_, first ? b.v : a.v);
      const float nearest = static_cast<float>(sum);
      return finish(nearest, sum - nearest);
    }
  }
  const float s = a.v + b.v, t = s - a.v;
  return finish(s, (a.v - (s - t)) + (b.v - t));
}
Deviant operator*(Deviant a, Deviant b) {
  const float p = a.v * b.v;
  Deviant r = finish(p, static_cast<double>(a.v) * b.v - p);
  r.factor_ = a.v;
  r.other_ = b.v;
  r.product_ = true;
  return r;
}
Deviant operator/(Deviant a, Deviant b) {
  if (is(Slip::reciprocal_division)) return finish(a.v * (1.0f / b.v), 0);
  if (is(Slip::division_by_estimate)) return finish(a.v * beside(1.0f / b.v, true), 0);
  const double quotient = exact(a) / b.v;
  if (take(&Liberties::reciprocal)) {
    const Accuracy& allowed = current.liberties->rules.division;
    if (const float r = a.v * (1.0f / b.v); within(r, quotient, bound_of(quotient, allowed, 0), allowed)) return finish(r, 0);
  }
  return erring(a.v / b.v, quotient, &Profile::division);
}
Deviant Deviant::load_unorm(Unorm8 code) {
  // 0 and 1 are exact everywhere.
  if (code.code == 0 || code.code == 255) return of(plain::to_float(code));
  return erring(plain::to_float(code), code.code / 255.0, &Profile::unorm_load);
}
Deviant inverse_sqrt(Deviant a) {
  const double root = 1 / __builtin_sqrt(exact(a));
  return erring(static_cast<float>(root), root, &Profile::inverse_sqrt);
}
Deviant sqrt(Deviant a) {
  if (is(Slip::root_missing)) return a;
  if (is(Slip::root_by_inverse)) return a.v > 0 ? finish(1.0f / (1.0f / __builtin_sqrtf(a.v)), 0) : a;
  if (a.v == 0) return a;
  if (current.liberties && current.liberties->rules.sqrt_is_inherited) return Deviant::of(1.0f) / inverse_sqrt(a);
  return erring(__builtin_sqrtf(a.v), __builtin_sqrt(exact(a)), &Profile::sqrt);
}
Deviant floor(Deviant a) {
  const Reference down = floor(reference(a));
  if (is(Slip::truncated_floor)) return Deviant::of(a.v < 0 && down.v != a.v ? down.v + 1 : down.v);
  if (is(Slip::rounded_floor)) return Deviant::of(floor(Reference(a.v + 0.5f)).v);
  return Deviant::of(down.v);
}
Deviant fract(Deviant a) {
  const Reference down = floor(reference(a));
  if (is(Slip::fract_by_truncation) && a.v < 0) return finish(a.v - (down.v == a.v ? down.v : down.v + 1), 0);
  return a - Deviant::of(down.v);
}
Deviant mix(Deviant a, Deviant b, Deviant t) {
  if (is(Slip::mix_swapped)) return b * (Deviant::of(1.0f) - t) + a * t;
  if (is(Slip::mix_by_difference) || take(&Liberties::mix_either)) return a + (b - a) * t;
  return a * (Deviant::of(1.0f) - t) + b * t;
}

Deviant exp(Deviant a) {
  if (is(Slip::exp_base_two)) return finish(exp2(reference(a)).v, 0);
  return erring(exp(reference(a)).v, exp_real(Real64(exact(a))).v, &Profile::exp, exact(a));
}
Deviant exp2(Deviant a) {
  if (is(Slip::exp2_base_e)) return finish(exp(reference(a)).v, 0);
  return erring(exp2(reference(a)).v, exp2_real(Real64(exact(a))).v, &Profile::exp2, exact(a));
}
namespace {
bool near_one(Deviant a) { return a.v >= 0.5f && a.v <= 2.0f; }
/// Of liberties only: a GPU's pow may be made of it.
Deviant log2(Deviant a) {
  const double y = coefficients::log2_e * log_real(Real64(exact(a))).v;
  return erring(static_cast<float>(y), y, near_one(a) ? &Profile::log2_near_one : &Profile::log2);
}
constexpr double degree = 0x1.1df46a2529d39p-6;  // pi / 180
/// sin or cos, `exact` at x.
Deviant wave(float nearest, double exact, double x) {
  if (!current.liberties) return finish(nearest, 0);
  const Profile& p = current.liberties->rules;
  Accuracy a = p.sin_cos;
  if (p.sin_cos_domain > 0 && magnitude(x) > p.sin_cos_domain) {
    if (p.sin_cos_beyond == 0) return Deviant::of(static_cast<float>(swing()));
    a.absolute = std::max(a.absolute, p.sin_cos_beyond * magnitude(x));
  }
  const double bound = bound_of(exact, a, x);
  const float r = static_cast<float>(std::clamp(exact + bound * swing(), -1.0, 1.0));
  return finish(within(r, exact, bound, a) ? r : nearest, 0);
}
}  // namespace
Deviant log(Deviant a) {
  return erring(log(reference(a)).v, log_real(Real64(exact(a))).v, near_one(a) ? &Profile::log_near_one : &Profile::log);
}
Deviant pow(Deviant a, Deviant b) {
  if (is(Slip::pow_squared)) return a * a;
  if (current.liberties && a.v > 0 && current.liberties->rules.pow_is_inherited) return exp2(b * log2(a));
  const float nearest = pow(reference(a), reference(b)).v;
  return a.v > 0 ? erring(nearest, pow_real(Real64(exact(a)), Real64(exact(b))).v, &Profile::pow) : finish(nearest, 0);
}
Deviant sin(Deviant a) {
  const double x = is(Slip::degrees) ? exact(a) * degree : exact(a);
  return wave(sin(Reference(static_cast<float>(x))).v, sin_real(Real64(x)).v, x);
}
Deviant cos(Deviant a) {
  const double x = is(Slip::degrees) ? exact(a) * degree : exact(a);
  return wave(cos(Reference(static_cast<float>(x))).v, cos_real(Real64(x)).v, x);
}
Deviant atan2(Deviant y, Deviant x) {
  if (is(Slip::atan2_swapped)) return finish(atan2(reference(x), reference(y)).v, 0);
  // Not every device keeps the sign of a zero.
  if (current.liberties && y.v == 0) y.v = coin() ? 0.0f : -0.0f;
  return erring(atan2(reference(y), reference(x)).v, atan2_real(Real64(exact(y)), Real64(exact(x))).v, &Profile::atan2);
}

namespace {
/// The terms in an order of the machine's own.
template <std::size_t Count>
Deviant shuffled_sum(std::array<Deviant, Count> terms) {
  for (std::size_t i = Count - 1; i > 0; --i) std::swap(terms[i], terms[draw() % (i + 1)]);
  if (Count == 4 && coin()) return (terms[0] + terms[1]) + (terms[2] + terms[3]);
  Deviant sum = terms[0];
  for (std::size_t i = 1; i < Count; ++i) sum = sum + terms[i];
  return sum;
}
}  // namespace
Deviant sum_any_order(Deviant a, Deviant b, Deviant c) {
  if (is(Slip::sum_backwards)) return (c + b) + a;
  if (is(Slip::sum_otherwise_paired)) return a + (b + c);
  if (take(&Liberties::reorder)) return shuffled_sum<3>({a, b, c});
  return (a + b) + c;
}
Deviant sum_any_order(Deviant a, Deviant b, Deviant c, Deviant d) {
  if (is(Slip::sum_backwards)) return ((d + c) + b) + a;
  if (is(Slip::sum_otherwise_paired)) return (a + b) + (c + d);
  if (take(&Liberties::reorder)) return shuffled_sum<4>({a, b, c, d});
  return ((a + b) + c) + d;
}
Deviant sum_any_order_in_pairs(Deviant a, Deviant b, Deviant c, Deviant d) {
  if (is(Slip::sum_backwards)) return ((d + c) + b) + a;
  if (is(Slip::sum_otherwise_paired)) return (a + c) + (b + d);
  if (take(&Liberties::reorder)) return shuffled_sum<4>({a, b, c, d});
  return (a + b) + (c + d);
}
Deviant smoothstep(float edge0, float edge1, Deviant x) {
  if (is(Slip::smoothstep_linear)) return plain::saturate((x - Deviant(edge0)) / Deviant(edge1 - edge0));
  if (!current.liberties) return plain::smoothstep<Deviant>(edge0, edge1, x);
  // The edges' difference is the device's own.
  const Deviant t = plain::saturate((x - Deviant(edge0)) / (Deviant(edge1) - Deviant(edge0)));
  return t * t * (Deviant(3.0f) - Deviant(2.0f) * t);
}
Deviant uniform_quotient(float a, float b, Deviant) { return current.liberties ? Deviant(a) / Deviant(b) : Deviant(a / b); }
plain::Vec3<Deviant> normalize(const plain::Vec3<Deviant>& a) {
  if (is(Slip::normalize_missing)) return a;
  if (take(&Liberties::normalize_any)) {
    const Deviant squared = plain::dot(a, a);
    if (coin()) return inverse_sqrt(squared) * a;
    const Deviant length = sqrt(squared);
    return {a.x / length, a.y / length, a.z / length};
  }
  return plain::normalize<Deviant>(a);
}
plain::Vec3<Deviant> reflect(const plain::Vec3<Deviant>& v, const plain::Vec3<Deviant>& n) {
  if (is(Slip::reflect_doubled_missing)) return v - plain::dot(n, v) * n;
  return plain::reflect<Deviant>(v, n);
}
plain::Vec3<Deviant> refract(const plain::Vec3<Deviant>& v, const plain::Vec3<Deviant>& n, float eta) {
  return plain::refract<Deviant>(v, n, is(Slip::refract_ratio_inverted) ? 1.0f / eta : eta);
}
Deviant nearest_octave(Deviant x) {
  const Deviant level = plain::nearest_octave<Deviant>(x);
  if (is(Slip::level_above)) return level + Deviant(1.0f);
  if (is(Slip::level_below)) return plain::nearest_octave<Deviant>(x * Deviant(0.5f));
  return level;
}

Sampler::Sampler() : is_used(current.liberties && current.liberties->rules.subtexel_bits > 0 && coin()) {}
float Sampler::coordinate(float u) const {
  if (!is_used || current.liberties->rules.coordinate_bits == 0) return u;
  // 0.9 leaves room for the rounding of the sum.
  return static_cast<float>(u + 0.9 * swing() * u * power_of_two(-current.liberties->rules.coordinate_bits));
}
namespace {
/// x in fixed point: cut, rounded, or anything between.
float snapped(float x, int bits) {
  const double steps = power_of_two(bits), offset = std::min(0.5 + 0.5 * swing(), 1 - 0x1p-20);
  return static_cast<float>(floor(plain::Plain<double>(plain::Plain<double>(x * steps + offset))).v / steps);
}
}  // namespace
float Sampler::texel(float x) const { return is_used ? snapped(x, current.liberties->rules.subtexel_bits) : x; }
float Sampler::level(float lod) const {
  return current.liberties && current.liberties->rules.lod_bits > 0 ? snapped(lod, current.liberties->rules.lod_bits) : lod;
}

float Sampler::blend(float in_float, float a, float b, float c, float d, bool inside_cell, int bits) const {
  if (!is_used) return in_float;
  const double twist = inside_cell ? magnitude(static_cast<double>(a) - b - c + d) : 0;  // weights of 0 stay 0
  const double value = in_float + swing() * power_of_two(-current.liberties->rules.subtexel_bits) * twist;
  const auto [least, greatest] = std::minmax({a, b, c, d});
  return std::clamp(stored(static_cast<float>(value), bits), least, greatest);
}
float Sampler::stored(float in_float, int bits) const {
  double value = in_float;
  const bool up = current.lean != 0 && (draw() & 7) != 0 ? current.lean > 0 : coin();
  if (bits == 0) {
    value = floor(plain::Plain<double>(plain::Plain<double>(value * 255 + (up ? 1 - 0x1p-20 : 0)))).v / 255;
  } else if (bits == 11) {
    const float x = static_cast<float>(value);
    const Half cut = to_half(x, Rounding::rtz);
    const bool away = to_float(cut) != x && up == (x > 0);
    value = to_float(Half{static_cast<std::uint16_t>(cut.bits + (away ? 1 : 0))});
  }
  return static_cast<float>(value);
}
bool Sampler::rounds_jointly() const { return is_used && coin(); }
bool Sampler::takes_x_first() const { return coin(); }
Share& share() {
  thread_local Share current_share;
  return current_share;
}
float Sampler::weighted(float a, float b, float c, float d, float fx, float fy, float share, bool x_first) const {
  if (!x_first) {
    std::swap(b, c);
    std::swap(fx, fy);
  }
  const double steps = power_of_two(current.liberties->rules.subtexel_bits), whole = steps * static_cast<double>(share);
  // To the nearest; which way a tie goes is anyone's.
  const auto rounded = [](double x) {
    const double down = floor(plain::Plain<double>(plain::Plain<double>(x))).v, rest = x - down;
    return rest > 0.5 || (rest == 0.5 && coin()) ? down + 1 : down;
  };
  const double right = rounded(whole * static_cast<double>(fx)), left = whole - right;
  const double right_above = rounded(right * static_cast<double>(fy)), left_above = rounded(left * static_cast<double>(fy));
  return static_cast<float>(((left - left_above) * a + (right - right_above) * b + left_above * c + right_above * d) / steps);
}

Liberties liberties_of(const Profile& p) {
  Liberties all;
  all.rules = p;
  all.reorder = all.mix_either = all.reciprocal = all.normalize_any = !p.reference;
  return all;
}

const std::vector<SlipInfo>& slips() {
  static const std::vector<SlipInfo> all{
      {Slip::fused, "fused multiply-add", "products are fused with the addition that follows"},
      {Slip::reciprocal_division, "division by reciprocal", "a / b is computed as a * (1 / b)"},
      {Slip::root_by_inverse, "root by inverse root", "sqrt(x) is computed as 1 / inversesqrt(x)"},
      {Slip::flushed, "subnormals flushed", "subnormal results become zero"},
      {Slip::mix_by_difference, "mix as a + (b - a) t", "mix is computed by the difference, not as a (1 - t) + b t"},
      {Slip::sum_backwards, "sum backwards", "sums are added from the last term to the first"},
      {Slip::sum_otherwise_paired, "sum paired otherwise", "sums are added in other pairs"},
      {Slip::division_by_estimate, "division by estimate", "1 / b is an estimate, one ULP off"},
      {Slip::half_intermediates, "half intermediates", "intermediate results have half precision (min16float, mediump, half)"},
      {Slip::half_constants, "half constants", "literals and uniforms have half precision"},
      {Slip::strict_for_weak, "> for >=", "a comparison with equality is strict (or < for <=)"},
      {Slip::weak_for_strict, ">= for >", "a strict comparison includes equality (or <= for <)"},
      {Slip::truncated_floor, "truncation for floor", "floor of a negative number is cut toward zero, as int() does"},
      {Slip::rounded_floor, "rounding for floor", "an index is rounded to nearest instead of down"},
      {Slip::fract_by_truncation, "fract by truncation", "fract of a negative number is negative, as fmod's is"},
      {Slip::minimum_missing, "upper clamp missing", "a min() or the upper end of a clamp is missing"},
      {Slip::maximum_missing, "lower clamp missing", "a max() or the lower end of a clamp is missing"},
      {Slip::abs_missing, "abs missing", "an abs() is missing"},
      {Slip::normalize_missing, "normalize missing", "a vector is not normalized"},
      {Slip::smoothstep_linear, "linear for smoothstep", "smoothstep is a linear ramp"},
      {Slip::root_missing, "root missing", "a squared length is taken for the length"},
      {Slip::square_missing, "square missing", "a number is taken for its square"},
      {Slip::refract_ratio_inverted, "refraction ratio inverted", "refract() gets n2 / n1 instead of n1 / n2"},
      {Slip::reflect_doubled_missing, "factor 2 of reflect missing", "reflect is v - (n.v) n"},
      {Slip::exp_base_two, "exp2 for exp", "an exponential has base 2 instead of e"},
      {Slip::exp2_base_e, "exp for exp2", "an exponential has base e instead of 2"},
      {Slip::pow_squared, "square for pow", "a power is approximated by a square"},
      {Slip::mix_swapped, "mix ends swapped", "mix has its ends swapped"},
      {Slip::atan2_swapped, "atan2 arguments swapped", "atan2 gets (x, y)"},
      {Slip::degrees, "degrees for radians", "an angle in radians is taken for degrees"},
      {Slip::address_clamped, "clamp address mode", "a texture that repeats is clamped"},
      {Slip::address_repeated, "repeat address mode", "a texture that is clamped repeats"},
      {Slip::address_mirrored, "mirror address mode", "a texture is mirrored at its edges"},
      {Slip::nearest_filter, "nearest for linear", "a texture is filtered by the nearest texel"},
      {Slip::weights_of_8_bits, "8-bit filter weights", "a texture unit filters with weights of 8 bits"},
      {Slip::half_texel_missing, "half texel missing", "texel centres are taken at k instead of k + 1/2"},
      {Slip::half_texel_twice, "half texel twice", "the half texel is taken off twice"},
      {Slip::texel_after, "one texel off", "a lookup is one texel off"},
      {Slip::level_above, "mip level above", "the mip level is one too coarse"},
      {Slip::level_below, "mip level below", "the mip level is one too fine"},
  };
  return all;
}

}  // namespace rainref::deviant
