// The enclosure of single operations: the reference's point under ieee, how wide results are, what is vacuous.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "math/enclosure.h"
#include "math/profiles.h"

namespace rainref::test {
namespace {

using namespace rainref::scalar;  // the vocabulary, as a pass sees it
using enclosed::BasicRounding;
using enclosed::Enclosure;
using enclosed::Flush;
using enclosed::PathEnumeration;
using enclosed::Profile;
using enclosed::ProfileScope;

using Single = scalar::Scalar<float>;

std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
::testing::AssertionResult is_point(Enclosure e, Single expected) {
  if (bits(e.lo) == bits(expected.v) && bits(e.hi) == bits(expected.v)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "[" << e.lo << ", " << e.hi << "], reference " << expected.v;
}

std::vector<float> operands() {
  std::vector<float> out{0.0f,     -0.0f,     1.0f,      -1.0f,      0.5f,         2.0f,         3.0f,   1.0f / 3, 0.1f,  255.0f,
                         65504.0f, 0x1p-126f, 0x1p-149f, -0x1p-130f, 1 - 0x1p-24f, 1 + 0x1p-23f, 1e-20f, 1e10f,    -7.25f};
  std::mt19937 words(1);
  while (out.size() < 200) {
    const float mantissa = static_cast<float>(words()) * 0x1p-31f - 1;
    out.push_back(std::ldexp(mantissa, static_cast<int>(words() % 40) - 20));
  }
  return out;
}

// One list of every operation of two numbers that passes use, for points that a pass may give them.
template <class N>
std::vector<N> every_operation(N a, N b) {
  std::vector<N> out{a + b,
                     a - b,
                     a * b,
                     -a,
                     min(a, b),
                     max(a, b),
                     abs(a),
                     square(a),
                     floor(a),
                     fract(a),
                     mix(a, b, fract(b)),
                     exp(a),
                     exp2(a),
                     sin(a),
                     cos(b),
                     atan2(a, b),
                     select(a < b, a, b),
                     clamp(a, b, b + N(1.0f)),
                     saturate(a),
                     smoothstep(0.25f, 0.75f, a),
                     smoothstep(4.0f, 0.5f, b),
                     sum_any_order(a, b, a * b),
                     sum_any_order(a, b, a, b),
                     sum_any_order_in_pairs(a, b, b, a),
                     nearest_octave(abs(a)),
                     length(a, b),
                     sqrt(abs(a)),
                     log(max(abs(a), N(1e-20f))),
                     pow(abs(a), N(2.2f)),
                     a / max(abs(b), N(1e-10f)),
                     to_number(to_int(floor(clamp(a, N(-1e6f), N(1e6f)))))};
  const scalar::Vec3<N> v(a, b, N(1.0f)), n = normalize(v), r = reflect(v, n),
                                          t = refract(n, scalar::Vec3<N>(N(0.0f), N(1.0f), N(0.0f)), 0.75f);
  for (const scalar::Vec3<N>& w : {n, r, t}) out.insert(out.end(), {w.x, w.y, w.z});
  out.push_back(dot(v, n));
  out.push_back(length(v));
  return out;
}

TEST(Enclosure, IsTheReferencesPointUnderIeee) {
  const ProfileScope scope(profile_named("ieee"));
  const std::vector<float> x = operands();
  for (const float a : x) {
    for (const float b : x) {
      const auto expected = every_operation<Single>(a, b);
      const auto got = every_operation<Enclosure>(a, b);
      for (std::size_t i = 0; i < got.size(); ++i) {
        if (expected[i].v != expected[i].v)
          ASSERT_TRUE(got[i].is_vacuous()) << i;
        else
          ASSERT_TRUE(is_point(got[i], expected[i])) << "operation " << i << " of " << a << " and " << b;
      }
    }
  }
}

// What is exact stays a point, whatever the profile: sums of small integers, products with powers of two, comparisons.
TEST(Enclosure, ExactResultsStayPoints) {
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    for (const float a : {0.0f, 1.0f, -3.0f, 0.375f, 1000.0f}) {
      for (const float b : {0.5f, 2.0f, -4.0f}) {
        const Enclosure x(a), y(b);
        for (const Enclosure& e : {x + y, x - y, x * y, square(x), abs(x), floor(x), min(x, y), max(x, y), fract(x), sum_any_order(x, y, x),
                                   sum_any_order(x, y, x, y), sum_any_order_in_pairs(x, y, y, x), mix(x, y, Enclosure(0.0f)),
                                   mix(x, y, Enclosure(0.5f)), dot(scalar::Vec3<Enclosure>(x, y, x), scalar::Vec3<Enclosure>(y, y, x))}) {
          EXPECT_TRUE(e.is_point()) << p.name << ' ' << a << ' ' << b << ": " << e.lo << ' ' << e.hi;
        }
      }
    }
    EXPECT_TRUE(smoothstep(0.0f, 1.0f, Enclosure(0.0f)).is_point());
    EXPECT_TRUE(smoothstep(0.0f, 1.0f, Enclosure(-1.0f)).is_point());
  }
}
TEST(Enclosure, OneOperationIsAsWideAsItsRule) {
  std::mt19937 words(2);
  const auto random = [&] { return 0.5f + static_cast<float>(words() >> 8) * 0x1p-24f; };
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    double sum = 0, product = 0, fused = 0, quotient = 0, root = 0, order = 0;
    for (int i = 0; i < 2000; ++i) {
      const Enclosure a(random()), b(random()), c(random());
      sum = std::max(sum, (a + b).width_in_ulp());
      product = std::max(product, (a * b).width_in_ulp());
      fused = std::max(fused, (a * b).unrounded().width_in_ulp());
      quotient = std::max(quotient, (a / b).width_in_ulp());
      root = std::max(root, sqrt(a).width_in_ulp());
      order = std::max(order, sum_any_order(a, b, c).width_in_ulp());
    }
    const bool either = p.basic == BasicRounding::either;
    EXPECT_EQ(sum, either ? 1 : 0) << p.name;
    EXPECT_EQ(product, either ? 1 : 0) << p.name;
    EXPECT_EQ(fused, p.reference ? 0 : 1) << p.name;  // as an addition may take it
    // n ULP to both sides and the rounding of each end; below a power of two a ULP counts twice.
    EXPECT_LE(quotient, p.division.is_zero() ? 0 : 2 * (2 * p.division.ulp + 1)) << p.name;
    EXPECT_GE(quotient, 2 * p.division.ulp - 1) << p.name;
    if (!p.sqrt_is_inherited) {
      EXPECT_LE(root, p.sqrt.is_zero() ? 0 : 2 * (2 * p.sqrt.ulp + 1)) << p.name;
    }
    EXPECT_LE(order, p.reference ? 0 : 3) << p.name;
  }
}
TEST(Enclosure, SumsInAnyOrderHoldEachOrder) {
  const ProfileScope scope(profile_named("cuda"));
  const float big = 0x1p24f;
  const Enclosure sum = sum_any_order(Enclosure(big), Enclosure(1.0f), Enclosure(-big));
  EXPECT_EQ(sum.lo, 0.0f);  // (big + 1) - big
  EXPECT_EQ(sum.hi, 2.0f);  // the other neighbour, as outward sums have it; (big - big) + 1 lies between
}

TEST(Enclosure, SubnormalsMayBeZeroWhereTheProfileSaysSo) {
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    const bool flushes = p.flush != Flush::never;
    EXPECT_EQ(Enclosure(0x1p-130f).contains(0.0f), flushes) << p.name;
    EXPECT_EQ(Enclosure(-0x1p-130f).contains(0.0f), flushes) << p.name;
    EXPECT_EQ((Enclosure(0x1.8p-125f) - Enclosure(0x1p-125f)).contains(0.0f), flushes) << p.name;
    EXPECT_EQ((Enclosure(0x1p-70f) * Enclosure(0x1p-70f)).contains(0.0f), flushes) << p.name;
    EXPECT_FALSE((Enclosure(0x1p-60f) * Enclosure(0x1p-60f)).contains(0.0f)) << p.name;
  }
}

TEST(Enclosure, WhatMayBeInfiniteOrUndefinedIsVacuousAndStaysSo) {
  const Enclosure zero(0.0f), one(1.0f), around(-1.0f, 1.0f);
  for (const Profile& p : profiles()) {
    if (p.reference) continue;
    const ProfileScope scope(p);
    for (const Enclosure& e : {one / zero, one / around, sqrt(Enclosure(-1.0f)), sqrt(around), log(zero), log(around), pow(around, one),
                               exp(Enclosure(100.0f)), exp2(Enclosure(130.0f)), Enclosure(3e38f) + Enclosure(3e38f),
                               Enclosure(1e30f) * Enclosure(1e30f), Enclosure(INFINITY), Enclosure(NAN)}) {
      EXPECT_TRUE(e.is_vacuous()) << p.name << ": " << e.lo << ' ' << e.hi;
      for (const Enclosure& after :
           {e + one, one - e, e * zero, e / one, one / e, abs(e), min(e, one), max(e, one), square(e), sqrt(e), exp(e), sin(e),
            mix(one, zero, e), atan2(e, one), sum_any_order(one, e, one), smoothstep(0.0f, 1.0f, e), saturate(e), floor(e), fract(e)}) {
        EXPECT_TRUE(after.is_vacuous()) << p.name;
      }
    }
  }
}

TEST(Enclosure, FunctionsKeepTheirCodomain) {
  std::mt19937 words(3);
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    for (int i = 0; i < 2000; ++i) {
      const float x = static_cast<float>(words() * 0x1p-29 - 4);
      const Enclosure a(x, x + static_cast<float>(words() * 0x1p-32));
      EXPECT_GE(exp(a).lo, 0);
      EXPECT_GE(sqrt(abs(a)).lo, 0);
      EXPECT_GE(pow(abs(a), Enclosure(2.2f)).lo, 0);
      const Enclosure s = sin(a), f = fract(Enclosure(x + 20));
      EXPECT_TRUE(s.is_vacuous() || (s.lo >= -1 && s.hi <= 1));
      EXPECT_TRUE(f.lo >= 0 && f.hi <= 1);
      if (p.reference) continue;
      const scalar::Vec3<Enclosure> n = normalize(scalar::Vec3<Enclosure>(a, Enclosure(1e-6f), Enclosure(1e-6f)));
      EXPECT_TRUE(n.x.is_vacuous() || (n.x.lo >= -1.00001f && n.x.hi <= 1.00001f)) << p.name;
    }
  }
}
TEST(Enclosure, SineHasItsExtremaInside) {
  const ProfileScope scope(profile_named("typical"));
  for (int k = -20; k <= 20; ++k) {
    const auto top = static_cast<float>((2 * k + 0.5) * 3.14159265358979), bottom = static_cast<float>((2 * k - 0.5) * 3.14159265358979);
    EXPECT_EQ(sin(Enclosure(top - 0.1f, top + 0.1f)).hi, 1.0f);
    EXPECT_GT(sin(Enclosure(top - 0.1f, top + 0.1f)).lo, 0.9f);
    EXPECT_EQ(sin(Enclosure(bottom - 0.1f, bottom + 0.1f)).lo, -1.0f);
    EXPECT_LT(sin(Enclosure(bottom - 0.1f, bottom + 0.1f)).hi, -0.9f);
    EXPECT_LT(sin(Enclosure(top + 0.1f, top + 0.2f)).hi, 0.999f);
  }
}
// Beyond its domain a sine is what the profile says: a convention, or nothing.
TEST(Enclosure, SineBeyondItsDomainIsNeverSilentlyBounded) {
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    const Enclosure far = sin(Enclosure(1000.0f));
    if (p.sin_cos_domain == 0)
      EXPECT_LT(far.hi - far.lo, 1e-6f) << p.name;
    else if (p.sin_cos_beyond == 0)
      EXPECT_TRUE(far.is_vacuous()) << p.name;
    else
      EXPECT_GE(far.hi - far.lo, p.sin_cos_beyond * 1000) << p.name;
  }
}

TEST(Enclosure, TheArcTangentJumpsAtItsCutOnly) {
  const ProfileScope scope(profile_named("vulkan"));
  const auto alternatives = [](Enclosure y, Enclosure x) {
    std::vector<Enclosure> found;
    PathEnumeration paths;
    EXPECT_TRUE(paths.for_each_alternative([&] { found.push_back(atan2(y, x)); }));
    return found;
  };
  const Enclosure left(-1.0f), right(1.0f), across(-1e-3f, 1e-3f);
  EXPECT_EQ(alternatives(across, right).size(), 1u);
  const auto cut = alternatives(across, left);
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_LT(cut[0].hi, -3.1f);
  EXPECT_GT(cut[1].lo, 3.1f);
  EXPECT_EQ(alternatives(Enclosure(0.0f), left).size(), 2u);  // a zero's sign may be lost
  const auto origin = alternatives(across, across);
  ASSERT_EQ(origin.size(), 1u);
  EXPECT_LE(origin[0].lo, -3.14f);
  EXPECT_GE(origin[0].hi, 3.14f);
}
// WGSL promises nothing but for |x| in [2^-126, 2^126] and y finite and normal; 0 is not normal.
TEST(Enclosure, TheArcTangentHasADomain) {
  const float least = 0x1p-126f, most = 0x1p126f, subnormal = 0x1p-127f;
  const struct {
    Enclosure y, x;
    bool is_promised;
  } cases[] = {{{1, 1}, {1, 1}, true},
               {{least, least}, {1, 1}, true},
               {{-least, -least}, {-1, -1}, true},
               {{3e38f, 3e38f}, {-most, -most}, true},
               {{1, 1}, {least, most}, true},
               {{1, 1}, {-most, -least}, true},
               {{-2, -1}, {1, 2}, true},
               {{subnormal, subnormal}, {1, 1}, false},
               {{-subnormal, -subnormal}, {1, 1}, false},
               {{0, 0}, {1, 1}, false},
               {{0, 0}, {-1, -1}, false},
               {{0, 1}, {1, 1}, false},
               {{-1, 1}, {1, 1}, false},
               {{1, 1}, {0, 0}, false},
               {{1, 1}, {-1, 1}, false},
               {{1, 1}, {subnormal, 1}, false},
               {{1, 1}, {1, 1.0001f * most}, false},
               {{0, 0}, {0, 0}, false}};
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    for (const auto& c : cases) {
      bool is_bounded = true;
      PathEnumeration paths;
      EXPECT_TRUE(paths.for_each_alternative([&] { is_bounded &= !atan2(c.y, c.x).is_vacuous(); }));
      EXPECT_EQ(is_bounded, c.is_promised || p.name != "webgpu")
          << p.name << " y [" << c.y.lo << ", " << c.y.hi << "] x [" << c.x.lo << ", " << c.x.hi << "]";
    }
  }
}
// Each specification names t t (3 - 2 t) and lets it be regrouped: both groupings, rounded as it lies and fused, are within.
TEST(Enclosure, SmoothstepHoldsBothGroupings) {
  std::mt19937 words(7);
  const auto random = [&] { return static_cast<float>(words() >> 8) * 0x1p-24f; };
  for (const Profile& p : profiles()) {
    if (p.reference) continue;
    const ProfileScope scope(p);
    int apart = 0;
    for (int i = 0; i < 20000; ++i) {
      const float edge = random() - 0.5f, x = random(), t = i % 2 == 0 ? x : std::clamp((x - edge) / (1.5f - edge), 0.0f, 1.0f);
      const Enclosure e = i % 2 == 0 ? smoothstep(0.0f, 1.0f, Enclosure(x)) : smoothstep(edge, 1.5f, Enclosure(x));
      const float slope = 3.0f - 2.0f * t, fused = std::fma(-2.0f, t, 3.0f);
      for (const float s : {slope, fused}) {
        const float left = t * t * s, right = t * (t * s);
        apart += left != right;
        ASSERT_TRUE(e.contains(left)) << p.name << ' ' << x << ": " << left << " outside [" << e.lo << ", " << e.hi << "]";
        ASSERT_TRUE(e.contains(right)) << p.name << ' ' << x << ": " << right << " outside [" << e.lo << ", " << e.hi << "]";
      }
    }
    EXPECT_GT(apart, 5000) << "the groupings give the same numbers";
  }
}
TEST(Enclosure, AnOctaveIsOneDecision) {
  const auto levels = [](Enclosure x) {
    std::vector<float> found;
    PathEnumeration paths;
    EXPECT_TRUE(paths.for_each_alternative([&] { found.push_back(nearest_octave(x).lo); }));
    return found;
  };
  EXPECT_EQ(levels(Enclosure(4.0f)), (std::vector<float>{2}));
  EXPECT_EQ(levels(Enclosure(5.0f, 6.0f)), (std::vector<float>{2, 3}));
  EXPECT_EQ(levels(Enclosure(1.0f, 8.0f)), (std::vector<float>{0, 1, 2, 3}));
  EXPECT_EQ(levels(Enclosure(0x1.6a09e6p+0f)), (std::vector<float>{1}));  // a tie of points is settled
}
TEST(Enclosure, MixBetweenNumbersOfOneSignKeepsIt) {
  std::mt19937 words(4);
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    for (int i = 0; i < 5000; ++i) {
      const auto r = [&] { return static_cast<float>(words() * 0x1p-32); };
      const float a = i % 3 ? r() : 0, t = r();
      const Enclosure e = mix(Enclosure(a, a + 0.5f), Enclosure(0.0f, r()), Enclosure(t * 0.5f, t));
      EXPECT_GE(e.lo, 0);
      EXPECT_LE(mix(Enclosure(-a - 0.5f, -a), Enclosure(-r(), 0.0f), Enclosure(t * 0.5f, t)).hi, 0);
    }
  }
}

}  // namespace
}  // namespace rainref::test
