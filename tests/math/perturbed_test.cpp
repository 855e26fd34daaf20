// The perturbed evaluation: without fault or variations the reference's bits, with one fault what that fault says, and with
// the variations of a profile what the profile allows.
#include <gtest/gtest.h>

#include <mpfr.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "math/perturbed.h"
#include "math/profiles.h"

namespace rainref::perturbed {
namespace {

using scalar::Scalar;
using scalar::Vec3;
using Single = Scalar<float>;
using enclosed::Accuracy;
using enclosed::Profile;

Perturbed d(float x) { return Perturbed::of(x); }

struct Case {
  Fault fault;
  std::function<float()> computed;
  float without, with;
};
// Each value worked out by hand; big + 1 is big.
constexpr float big = 1e8f, third = 1.0f / 3.0f, tiny = 0x1p-12f;
const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {Fault::fused, [] { return (d(1 + tiny) * d(1 + tiny) - d(1 + 2 * tiny)).v; }, 0, 0x1p-24f},
      {Fault::reciprocal_division, [] { return (d(5) / d(3)).v; }, 5.0f / 3.0f, 5.0f * third},
      {Fault::root_by_inverse, [] { return sqrt(d(3)).v; }, 0x1.bb67aep+0f, 0x1.bb67bp+0f},
      {Fault::flushed, [] { return (d(0x1p-100f) * d(0x1p-30f)).v; }, 0x1p-130f, 0},
      {Fault::mix_by_difference, [] { return mix(d(big), d(1), d(1)).v; }, 1, 0},
      {Fault::sum_backwards, [] { return sum_any_order(d(1), d(big), d(-big)).v; }, 0, 1},
      {Fault::sum_backwards, [] { return sum_any_order(d(1), d(1), d(big), d(-big)).v; }, 0, 2},
      {Fault::sum_otherwise_paired, [] { return sum_any_order(d(1), d(big), d(-big)).v; }, 0, 1},
      {Fault::sum_otherwise_paired, [] { return sum_any_order_in_pairs(d(1), d(big), d(1), d(-big)).v; }, 0, 2},
      {Fault::division_by_estimate, [] { return (d(1) / d(3)).v; }, third, 0x1.555558p-2f},
      {Fault::half_intermediates, [] { return (d(1) + d(tiny)).v; }, 1 + tiny, 1},
      {Fault::half_constants, [] { return Perturbed(1 + tiny).v; }, 1 + tiny, 1},
      {Fault::strict_for_weak, [] { return d(1) <= d(1) ? 1.0f : 0.0f; }, 1, 0},
      {Fault::strict_for_weak, [] { return d(1) >= d(1) ? 1.0f : 0.0f; }, 1, 0},
      {Fault::weak_for_strict, [] { return d(1) < d(1) ? 1.0f : 0.0f; }, 0, 1},
      {Fault::weak_for_strict, [] { return d(1) > d(1) ? 1.0f : 0.0f; }, 0, 1},
      {Fault::truncated_floor, [] { return floor(d(-1.5f)).v; }, -2, -1},
      {Fault::rounded_floor, [] { return floor(d(1.75f)).v; }, 1, 2},
      {Fault::fract_by_truncation, [] { return fract(d(-1.25f)).v; }, 0.75f, -0.25f},
      {Fault::minimum_missing, [] { return min(d(2), d(1)).v; }, 1, 2},
      {Fault::maximum_missing, [] { return max(d(1), d(2)).v; }, 2, 1},
      {Fault::abs_missing, [] { return abs(d(-1)).v; }, 1, -1},
      {Fault::normalize_missing, [] { return normalize(Vec3<Perturbed>(d(0), d(4), d(0))).y.v; }, 1, 4},
      {Fault::smoothstep_linear, [] { return smoothstep(0, 1, d(0.25f)).v; }, 0.15625f, 0.25f},
      {Fault::root_missing, [] { return sqrt(d(4)).v; }, 2, 4},
      {Fault::square_missing, [] { return square(d(3)).v; }, 9, 3},
      // At right angles of incidence and of the plane: sin is 0.6, so 0.3 with the ratio 1/2 and beyond 1 with 2.
      {Fault::refract_ratio_inverted,
       [] { return refract(Vec3<Perturbed>(d(0.6f), d(-0.8f), d(0)), Vec3<Perturbed>(d(0), d(1), d(0)), 0.5f).x.v; }, 0.3f, 0},
      {Fault::reflect_doubled_missing, [] { return reflect(Vec3<Perturbed>(d(0), d(-1), d(0)), Vec3<Perturbed>(d(0), d(1), d(0))).y.v; }, 1,
       0},
      {Fault::exp_base_two, [] { return exp(d(1)).v; }, 0x1.5bf0a8p+1f, 2},
      {Fault::exp2_base_e, [] { return exp2(d(1)).v; }, 2, 0x1.5bf0a8p+1f},
      {Fault::pow_squared, [] { return pow(d(3), d(4)).v; }, 81, 9},
      {Fault::mix_swapped, [] { return mix(d(1), d(2), d(0.25f)).v; }, 1.25f, 1.75f},
      {Fault::atan2_swapped, [] { return atan2(d(0), d(1)).v; }, 0, 0x1.921fb6p+0f},
      {Fault::degrees, [] { return sin(d(30)).v; }, -0.98803162f, 0.5f},
      {Fault::degrees, [] { return cos(d(180)).v; }, -0.598460078f, -1},
      {Fault::level_above, [] { return nearest_octave(d(4)).v; }, 2, 3},
      {Fault::level_below, [] { return nearest_octave(d(4)).v; }, 2, 1},
      {Fault::constant, [] { return Perturbed(2.5f).v; }, 2.5f, 3},
  };
  return all;
}

TEST(Perturbed, EachFaultIsWhatItsSentenceSays) {
  for (const Case& c : cases()) {
    EXPECT_EQ(c.computed(), c.without) << static_cast<int>(c.fault);
    Behaviour b;
    b.fault = c.fault;
    b.constant = 2.5f;
    b.replacement = 3;
    const Scope scope(b);
    EXPECT_EQ(c.computed(), c.with) << static_cast<int>(c.fault);
  }
}
// Snell's law takes the ratio 1 / n, its square, and Schlick's formula the reflectance ((n - 1) / (n + 1))^2 and its complement: a port
// with another index has others of each.
TEST(Perturbed, WhatIsMadeOfAConstantIsReplacedWithIt) {
  const float n = 1.333f, other = 1.5f;
  const auto straight_on = [](float index) { return (1 - index) / (1 + index) * ((1 - index) / (1 + index)); };
  const Scope scope(replacing(n, other));
  EXPECT_EQ(Perturbed(n).v, other);
  EXPECT_EQ(Perturbed(1 / n).v, 1 / other);
  EXPECT_EQ(Perturbed(n * n).v, other * other);
  EXPECT_EQ(Perturbed(1 / (n * n)).v, 1 / (other * other));
  EXPECT_EQ(Perturbed(straight_on(n)).v, straight_on(other));
  EXPECT_EQ(Perturbed(1 - straight_on(n)).v, 1 - straight_on(other));
  EXPECT_EQ(Perturbed(std::nextafter(1 / n, 1.0f)).v, std::nextafter(1 / n, 1.0f));
}
// A half is no reciprocal of 2 but a literal of its own, and the ratio does not say which index was meant.
TEST(Perturbed, WhatIsPlainerThanAConstantIsNotMadeOfIt) {
  {
    const Scope scope(replacing(2, 3));
    EXPECT_EQ(Perturbed(0.5f).v, 0.5f);
    EXPECT_EQ(Perturbed(4).v, 4);
  }
  const Scope scope(replacing(1 / 1.333f, 0.5f));
  EXPECT_EQ(Perturbed(1.333f).v, 1.333f);
}
TEST(Perturbed, EveryFaultIsInTheTableOrOneOfLookups) {
  const std::set<Fault> lookups{Fault::address_clamped,   Fault::address_repeated,   Fault::address_mirrored, Fault::nearest_filter,
                                Fault::weights_of_8_bits, Fault::half_texel_missing, Fault::half_texel_twice, Fault::texel_after};
  for (const Fault f : faults()) {
    const bool here = std::any_of(cases().begin(), cases().end(), [&](const Case& c) { return c.fault == f; });
    EXPECT_NE(here, lookups.contains(f)) << static_cast<int>(f);
  }
}

float any_number(std::mt19937& words) {
  return std::ldexp(static_cast<float>(words() >> 8) * (words() & 1 ? 0x1p-24f : -0x1p-24f), static_cast<int>(words() % 20) - 10);
}

// Against MPFR's fused multiply-add, which rounds once.
TEST(Perturbed, FusedIsCorrectlyRounded) {
  mpfr_t x, y, z, sum;
  for (mpfr_ptr number : {x, y, z, sum}) mpfr_init2(number, 24);
  std::mt19937 words(3);
  Behaviour b;
  b.fault = Fault::fused;
  const Scope scope(b);
  int differs = 0;
  for (int i = 0; i < 300000; ++i) {
    const float p = any_number(words), q = any_number(words);
    // Often close to cancelling the product, or beside a tie of the sum.
    float r = any_number(words);
    if (i % 3 == 0) r = -p * q;
    if (i % 3 == 1) r = std::ldexp(p * q, 24 + static_cast<int>(words() % 3)) * (words() & 1 ? 1.0f : -1.0f);
    mpfr_set_flt(x, p, MPFR_RNDN);
    mpfr_set_flt(y, q, MPFR_RNDN);
    mpfr_set_flt(z, r, MPFR_RNDN);
    mpfr_fma(sum, x, y, z, MPFR_RNDN);
    const float expected = mpfr_get_flt(sum, MPFR_RNDN);
    ASSERT_EQ((d(p) * d(q) + d(r)).v, expected) << p << ' ' << q << ' ' << r;
    ASSERT_EQ((d(r) + d(p) * d(q)).v, expected);
    ASSERT_EQ((d(r) - d(p) * d(q)).v, (d(r) + d(-p) * d(q)).v);
    differs += expected != p * q + r;
  }
  EXPECT_GT(differs, 50000);
  for (mpfr_ptr number : {x, y, z, sum}) mpfr_clear(number);
}

TEST(Perturbed, ConstantsAreCollected) {
  std::vector<float> met;
  Behaviour b;
  b.constants = &met;
  const Scope scope(b);
  const Perturbed product = Perturbed(2.5f) * d(3);
  EXPECT_EQ((product + Perturbed(-1.0f)).v, 6.5f);
  EXPECT_EQ(met, (std::vector<float>{2.5f, -1.0f}));
}

// ---- variations -----------------------------------------------------------------------------------------------------
template <class N>
std::vector<float> everything(const std::vector<float>& in) {
  const N a(in[0]), b(in[1]), c(in[2]), e(in[3]);
  const Vec3<N> v = normalize(Vec3<N>(a, b, c));
  std::vector<N> out{a + b,
                     a - b,
                     a * b,
                     a * b + c,
                     a / b,
                     sqrt(abs(a)),
                     floor(a),
                     fract(a),
                     mix(a, b, c),
                     exp(a),
                     exp2(b),
                     log(abs(a)),
                     pow(abs(a), b),
                     sin(a),
                     cos(b),
                     atan2(a, b),
                     sum_any_order(a, b, c),
                     sum_any_order(a, b, c, e),
                     sum_any_order_in_pairs(a, b, c, e),
                     smoothstep(-1.0f, 1.0f, a),
                     v.x,
                     v.y,
                     v.z,
                     nearest_octave(abs(a)),
                     uniform_quotient(in[0], in[1], N())};
  std::vector<float> values;
  for (const N& n : out) values.push_back(n.v);
  return values;
}
std::vector<float> some_numbers(std::mt19937& words) {
  std::uniform_real_distribution<float> at(-4, 4);
  return {at(words), at(words), at(words), at(words)};
}

TEST(Perturbed, WithoutVariationsItIsTheReference) {
  std::mt19937 words(4);
  const Variations none = variations_of(enclosed::reference_profile);
  for (int i = 0; i < 20000; ++i) {
    const std::vector<float> in = some_numbers(words), expected = everything<Single>(in);
    ASSERT_EQ(everything<Perturbed>(in), expected);
    Behaviour b;
    b.variations = &none;
    const Scope scope(b);
    ASSERT_EQ(everything<Perturbed>(in), expected);
  }
}

/// Whether every draw lies within the accuracy of the exact value, and some reach both sides.
void expect_drawn_within(const Profile& p, const std::string& what, const std::function<float(float)>& draw,
                         const std::function<double(double)>& exact, const Accuracy& a, float low, float high) {
  std::mt19937 words(5);
  std::uniform_real_distribution<float> at(low, high);
  int above = 0, below = 0;
  for (int i = 0; i < 4000; ++i) {
    const float x = at(words);
    behaviour().lean = i % 3 - 1;
    const double y = exact(x), got = draw(x), ulp = std::ldexp(1.0, std::ilogb(y) - 23);
    // Without an accuracy it is the nearest float.
    const double bound = a.is_zero() ? 0.5 * ulp : (a.ulp + a.ulp_per_x * std::abs(x)) * ulp + a.relative * std::abs(y) + a.absolute;
    ASSERT_LE(std::abs(got - y), bound * (1 + 1e-9) + 1e-18) << p.name << ' ' << what << ' ' << x;
    above += got - y > 0.7 * bound;
    below += y - got > 0.7 * bound;
  }
  EXPECT_GT(above, 100) << p.name << ' ' << what;
  EXPECT_GT(below, 100) << p.name << ' ' << what;
}
TEST(Perturbed, VariationsStayWithinTheProfileAndReachItsEnds) {
  for (const Profile& p : test::profiles()) {
    if (p.reference) continue;
    const Variations all = variations_of(p);
    Behaviour b;
    b.variations = &all;
    const Scope scope(b);
    expect_drawn_within(
        p, "division", [](float x) { return (d(x) / d(7.3f)).v; }, [](double x) { return x / 7.3f; }, p.division, 0.1f, 9);
    expect_drawn_within(
        p, "inverse_sqrt", [](float x) { return inverse_sqrt(d(x)).v; }, [](double x) { return 1 / std::sqrt(x); }, p.inverse_sqrt, 0.1f,
        9);
    if (!p.sqrt_is_inherited)
      expect_drawn_within(
          p, "sqrt", [](float x) { return sqrt(d(x)).v; }, [](double x) { return std::sqrt(x); }, p.sqrt, 0.1f, 9);
    expect_drawn_within(
        p, "exp", [](float x) { return exp(d(x)).v; }, [](double x) { return std::exp(x); }, p.exp, -5, 5);
    expect_drawn_within(
        p, "exp2", [](float x) { return exp2(d(x)).v; }, [](double x) { return std::exp2(x); }, p.exp2, -5, 5);
    expect_drawn_within(
        p, "log", [](float x) { return log(d(x)).v; }, [](double x) { return std::log(x); }, p.log, 3, 50);
    expect_drawn_within(
        p, "log near 1", [](float x) { return log(d(x)).v; }, [](double x) { return std::log(x); }, p.log_near_one, 1.1f, 1.9f);
    expect_drawn_within(
        p, "sin", [](float x) { return sin(d(x)).v; }, [](double x) { return std::sin(x); }, p.sin_cos, 0.1f, 1.2f);
    expect_drawn_within(
        p, "atan2", [](float x) { return atan2(d(x), d(0.7f)).v; }, [](double x) { return std::atan2(x, static_cast<double>(0.7f)); },
        p.atan2, 0.1f, 9);
  }
}

// Outside of what a profile promises of atan2 any angle comes.
TEST(Perturbed, DrawsAnyAngleOutsideTheDomain) {
  const Variations all = variations_of(test::profile_named("webgpu")), everywhere = variations_of(test::profile_named("vulkan"));
  const auto far_off = [](const Variations& v, float y, float x) {
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      Behaviour b;
      b.variations = &v;
      b.random = seed * 0x9e3779b97f4a7c15u;
      const Scope scope(b);
      count += std::abs(atan2(d(y), d(x)).v - std::atan2(y, x)) > 0.1f;
    }
    return count;
  };
  EXPECT_GT(far_off(all, 0.0f, 1.0f), 80);
  EXPECT_GT(far_off(all, 0x1p-127f, 1.0f), 80);
  EXPECT_GT(far_off(all, 1.0f, 0x1p127f), 80);
  EXPECT_EQ(far_off(all, 0x1p-126f, 1.0f), 0);
  EXPECT_EQ(far_off(all, 1.0f, -0.5f), 0);
  EXPECT_EQ(far_off(everywhere, 0.0f, 1.0f), 0);
}

// Every variation is taken: the results that a machine may choose between all appear, and no others.
TEST(Perturbed, RoundingsOrdersAndFormulasVary) {
  const auto results = [](const char* profile, const std::function<float()>& compute) {
    const Variations all = variations_of(test::profile_named(profile));
    Behaviour b;
    b.variations = &all;
    const Scope scope(b);
    std::set<float> seen;
    for (int i = 0; i < 2000; ++i) seen.insert(compute());
    return seen;
  };
  using Set = std::set<float>;
  const auto sum = [] { return (d(1) + d(0x1p-25f)).v; };
  EXPECT_EQ(results("vulkan", sum), (Set{1, 1 + 0x1p-23f}));
  EXPECT_EQ(results("cuda", sum), (Set{1}));
  const auto fused = [] { return (d(1 + tiny) * d(1 + tiny) - d(1 + 2 * tiny)).v; };
  EXPECT_EQ(results("cuda", fused), (Set{0, 0x1p-24f}));
  const auto subnormal = [] { return (d(0x1p-100f) * d(0x1p-30f)).v; };
  EXPECT_EQ(results("typical", subnormal), (Set{0, 0x1p-130f}));
  EXPECT_EQ(results("cuda", subnormal), (Set{0x1p-130f}));
  const auto order = [] { return sum_any_order(d(1), d(big), d(-big)).v; };
  EXPECT_EQ(results("cuda", order), (Set{0, 1}));
  const auto formula = [] { return mix(d(big), d(1), d(1)).v; };
  EXPECT_EQ(results("cuda", formula), (Set{0, 1}));
}

}  // namespace
}  // namespace rainref::perturbed
