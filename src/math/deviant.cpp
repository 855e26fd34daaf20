#include "math/deviant.h"

#include <array>

namespace rainref::deviant {
namespace {

using Reference = plain::Plain<float>;

thread_local Behaviour current;

/// splitmix64 (Steele, Lea, Flood 2014): draws of the liberties only.
std::uint64_t draw() {
  std::uint64_t z = current.random += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}
bool coin() { return draw() & 1; }
/// In [-1, 1].
double swing() { return static_cast<double>(draw() >> 11) * 0x1p-52 - 1; }

bool is(Slip slip) { return current.slip == slip; }
/// Whether this operation takes a liberty that is granted.
bool take(bool Liberties::*liberty) { return current.liberties && current.liberties->*liberty && coin(); }

float beside(float x, bool up) {
  if (x == 0) return up ? 0x1p-149f : -0x1p-149f;
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>((x > 0) == up ? bits + 1 : bits - 1);
}
bool subnormal(float x) { return x != 0 && x < 0x1p-126f && x > -0x1p-126f; }
float flushed(float x) {
  if (!subnormal(x)) return x;
  if (is(Slip::flushed) || take(&Liberties::flush)) return x < 0 ? -0.0f : 0.0f;
  return x;
}
/// What happens to every result: `nearest` is it correctly rounded, `error` has the sign of exact - nearest.
Deviant finish(float nearest, double error) {
  float r = nearest;
  if (error != 0 && take(&Liberties::either_neighbour)) r = beside(r, error > 0);
  if (is(Slip::half_intermediates)) r = to_float(to_half(r));
  return Deviant::of(flushed(r));
}
double ulp(double x) {
  const double magnitude = x < 0 ? -x : x;
  if (magnitude < 0x1p-126) return 0x1p-149;
  const auto exponent = std::bit_cast<std::uint64_t>(magnitude) & 0x7ff0000000000000u;
  return std::bit_cast<double>(exponent) * 0x1p-23;
}
/// A function's value with a random error of at most this many ULP and this much.
Deviant erring(Reference reference, double exact, double ulps, double absolute = 0) {
  if (!current.liberties || (ulps == 0 && absolute == 0)) return finish(reference.v, 0);
  const double reach = ulps * ulp(exact) > absolute ? ulps * ulp(exact) : absolute;
  return finish(static_cast<float>(exact + swing() * reach), 0);
}
double liberty(double Liberties::*of) { return current.liberties ? current.liberties->*of : 0; }
double magnitude(double x) { return x < 0 ? -x : x; }

/// a b + c rounded once: the sum of an exact product and c, made odd where inexact, rounds as the exact sum would.
float fused(float a, float b, float c) {
  const double p = static_cast<double>(a) * b, s = p + c, t = s - p, error = (p - (s - t)) + (c - t);
  if (error == 0 || s == 0) return static_cast<float>(s);
  auto bits = std::bit_cast<std::uint64_t>(s);
  if (!(bits & 1)) bits = (error > 0) == (s > 0) ? bits + 1 : bits - 1;
  return static_cast<float>(std::bit_cast<double>(bits));
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
    if (is(Slip::fused) || take(&Liberties::contract)) {
      const bool first = a.product_ && !(b.product_ && take(&Liberties::reorder));
      const Deviant& p = first ? a : b;
      return finish(fused(p.factor_, p.other_, first ? b.v : a.v), 0);
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
  if (is(Slip::reciprocal_division) || take(&Liberties::reciprocal)) return finish(a.v * (1.0f / b.v), 0);
  if (is(Slip::division_by_estimate)) return finish(a.v * beside(1.0f / b.v, true), 0);
  return erring(Reference(a.v) / Reference(b.v), exact(a) / b.v, liberty(&Liberties::division));
}
Deviant sqrt(Deviant a) {
  if (is(Slip::root_missing)) return a;
  if (is(Slip::root_by_inverse)) return a.v > 0 ? finish(1.0f / (1.0f / __builtin_sqrtf(a.v)), 0) : a;
  if (a.v == 0) return a;
  return erring(sqrt(reference(a)), __builtin_sqrt(exact(a)), liberty(&Liberties::root));
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
  return erring(exp(reference(a)), exp_real(Real64(exact(a))).v, liberty(&Liberties::exp) + liberty(&Liberties::exp_slope) * magnitude(exact(a)));
}
Deviant exp2(Deviant a) {
  if (is(Slip::exp2_base_e)) return finish(exp(reference(a)).v, 0);
  return erring(exp2(reference(a)), exp2_real(Real64(exact(a))).v, liberty(&Liberties::exp) + liberty(&Liberties::exp_slope) * magnitude(exact(a)));
}
Deviant log(Deviant a) {
  const bool near_one = a.v >= 0.5f && a.v <= 2.0f;
  return erring(log(reference(a)), log_real(Real64(exact(a))).v, liberty(&Liberties::log), near_one ? liberty(&Liberties::log_absolute) : 0);
}
Deviant pow(Deviant a, Deviant b) {
  if (is(Slip::pow_squared)) return a * a;
  return erring(pow(reference(a), reference(b)), pow_real(Real64(exact(a)), Real64(exact(b))).v, liberty(&Liberties::power));
}
namespace {
constexpr double degree = 0x1.1df46a2529d39p-6;  // pi / 180
}
Deviant sin(Deviant a) {
  const double x = is(Slip::degrees) ? exact(a) * degree : exact(a);
  return erring(sin(Reference(static_cast<float>(x))), sin_real(Real64(x)).v, 0, liberty(&Liberties::sine_absolute));
}
Deviant cos(Deviant a) {
  const double x = is(Slip::degrees) ? exact(a) * degree : exact(a);
  return erring(cos(Reference(static_cast<float>(x))), cos_real(Real64(x)).v, 0, liberty(&Liberties::sine_absolute));
}
Deviant atan2(Deviant y, Deviant x) {
  if (is(Slip::atan2_swapped)) return finish(atan2(reference(x), reference(y)).v, 0);
  return erring(atan2(reference(y), reference(x)), atan2_real(Real64(exact(y)), Real64(exact(x))).v, liberty(&Liberties::atan2));
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
  return plain::smoothstep<Deviant>(edge0, edge1, x);
}
plain::Vec3<Deviant> normalize(const plain::Vec3<Deviant>& a) {
  if (is(Slip::normalize_missing)) return a;
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

float filtered_coordinate(float x) {
  if (!current.liberties || current.liberties->subtexel_bits == 0) return x;
  const float steps = static_cast<float>(1 << current.liberties->subtexel_bits);
  // Cut, rounded, or anything between.
  const float offset = static_cast<float>(0.5 + 0.5 * swing());
  return floor(Reference(x * steps + offset)).v / steps;
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
