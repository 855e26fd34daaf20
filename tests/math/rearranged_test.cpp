// What a compiler may make of sums and products lies inside, and not far inside.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "math/enclosure.h"
#include "math/profiles.h"
#include "math/rearranged.h"
#include "math/rewriter.h"

namespace rainref::test {
namespace {

using enclosed::Enclosure;
using enclosed::PathEnumeration;
using enclosed::Profile;
using enclosed::ProfileScope;
using enclosed::Rearranged;
using enclosed::Rearrangement;
using random_gpu::toss;
using random_gpu::uniform;

std::vector<Profile> rearranging() {
  std::vector<Profile> out;
  for (const Profile& p : profiles())
    if (p.rearrangement == Rearrangement::distributed) out.push_back(p);
  return out;
}
Profile with(const char* name, Rearrangement how) {
  Profile p = profile_named(name);
  p.rearrangement = how;
  return p;
}
float draw(double low, double high) {
  return static_cast<float>(std::ldexp(uniform(1, 2) * (toss() ? 1 : -1), static_cast<int>(uniform(low, high))));
}
/// Leaves of ordinary size; some nearly cancel, some are whole, few are tiny or huge.
std::vector<float> leaves(int count) {
  std::vector<float> out;
  for (int k = 0; k < count; ++k) {
    switch (drawn(8)) {
      case 0:
        out.push_back(std::nextafterf(out.empty() ? 1.0f : -out.front(), 9));
        break;
      case 1:
        out.push_back(static_cast<float>(1 + drawn(9)));
        break;
      case 2:
        out.push_back(draw(-90, 20));
        break;
      default:
        out.push_back(draw(-5, 4));
    }
  }
  return out;
}

// RAINREF_FORMULAS sets how many; scripts/full/honesty takes more.
TEST(Rearranged, HoldsRandomRewritesOfRandomFormulas) {
  const char* wanted = std::getenv("RAINREF_FORMULAS");
  const int formulas = wanted ? std::atoi(wanted) : 4000;
  for (const Profile& p : rearranging()) {
    const ProfileScope scope(p);
    int bounded = 0, outside_as_written = 0, evaluations = 0;
    std::vector<double> slack;
    for (int trial = 0; trial < formulas; ++trial) {
      const std::vector<float> values = leaves(4);
      const Tree formula = random_formula(4, 3);
      const Enclosure all = as_written<Rearranged>(formula, values).settled(), written = as_written<Enclosure>(formula, values).unrounded();
      if (all.is_vacuous()) continue;
      ++bounded;
      const double exact = as_written<scalar::Scalar<double>>(formula, values).v;
      double worst = 0;
      for (int rewrite = 0; rewrite < 8; ++rewrite) {
        Tree t = formula;
        for (std::size_t k = 0, n = drawn(12); k < n; ++k) t = rewritten(t);
        const float got = computed(t, values).v;
        ASSERT_TRUE(all.contains(got)) << p.name << ", trial " << trial << ": " << got << " outside [" << all.lo << ", " << all.hi << "], "
                                       << text_of(formula) << " as " << text_of(t) << " of " << testing::PrintToString(values);
        ++evaluations;
        outside_as_written += !written.contains(got);
        worst = std::max(worst, std::abs(got - exact));
      }
      if (worst > 0) slack.push_back((static_cast<double>(all.hi) - all.lo) / 2 / worst);
    }
    EXPECT_GT(bounded, formulas * 7 / 8) << p.name;
    EXPECT_GT(outside_as_written, evaluations / 50) << p.name << ": nothing is tested where rewriting changes nothing";
    std::nth_element(slack.begin(), slack.begin() + static_cast<std::ptrdiff_t>(slack.size() / 2), slack.end());
    EXPECT_LT(slack[slack.size() / 2], 40) << p.name << ": the bound against the worst of eight rewrites";
  }
}

TEST(Rearranged, HoldsTheFormulaAsWrittenUnderEveryGrade) {
  for (const Rearrangement how : {Rearrangement::reassociated, Rearrangement::distributed, Rearrangement::expanded}) {
    const Profile p = with("vulkan", how);
    const ProfileScope scope(p);
    for (int trial = 0; trial < 4000; ++trial) {
      const std::vector<float> values = leaves(4);
      const Tree formula = random_formula(4, 3);
      const Enclosure all = as_written<Rearranged>(formula, values).settled(), written = as_written<Enclosure>(formula, values).unrounded();
      if (all.is_vacuous()) continue;
      const float got = as_written<random_gpu::RandomGpu>(formula, values).v;
      EXPECT_TRUE(all.contains(got)) << enclosed::name(how) << ' ' << got << " of [" << all.lo << ", " << all.hi << "] [" << written.lo
                                     << ", " << written.hi << "]";
    }
  }
}

// A grade that allows more is wider on average.
TEST(Rearranged, GradesGrow) {
  double width[3] = {};
  for (int trial = 0; trial < 2000; ++trial) {
    const std::vector<float> values = leaves(4);
    const Tree formula = random_formula(4, 3);
    Enclosure grades[3];
    for (int k = 0; k < 3; ++k) {
      const Profile p = with("vulkan", static_cast<Rearrangement>(k + 1));
      const ProfileScope scope(p);
      grades[k] = as_written<Rearranged>(formula, values).settled();
    }
    for (int k = 0; k < 3 && !grades[2].is_vacuous() && !grades[1].is_vacuous() && !grades[0].is_vacuous(); ++k) {
      const Enclosure e = grades[k];
      const float middle = std::max(1e-30f, std::abs(as_written<scalar::Scalar<float>>(formula, values).v));
      width[k] += std::log2((static_cast<double>(e.hi) - e.lo) / middle + 0x1p-24);
    }
  }
  EXPECT_LT(width[0], width[1]);
  EXPECT_LT(width[1], width[2]);
}

// ---- where a first formulation of the bound failed -----------------------------------------------------------------
template <class F>
Enclosure under(const Profile& p, const F& f) {
  const ProfileScope scope(p);
  return f().settled();
}
// With either neighbour an operation errs by 2^-23, not by half of that.
TEST(Rearranged, SumsMayRoundUpEachTime) {
  const float x[5] = {1.0f, 0x1.8p-24f, 0x1.8p-24f, 0x1.8p-24f, 0x1.8p-24f};
  float up = x[0];
  for (int k = 1; k < 5; ++k) up = std::nextafterf(up, 2);
  const auto sum = [&] { return Rearranged(x[0]) + Rearranged(x[1]) + Rearranged(x[2]) + Rearranged(x[3]) + Rearranged(x[4]); };
  EXPECT_TRUE(under(profile_named("vulkan"), sum).contains(up));
}
// Each term of a sum may be divided by itself, and the terms may cancel.
TEST(Rearranged, AQuotientIsLinearInItsNumerator) {
  const float a = 1.0f, b = std::nextafterf(1.0f, 2), c = 3.0f;
  const Enclosure e = under(profile_named("vulkan"), [&] { return (Rearranged(a) - Rearranged(b)) / Rearranged(c); });
  const float ulp = 0x1p-25f;  // of 1/3
  for (int k = -2; k <= 2; ++k)
    for (int j = -2; j <= 2; ++j) {
      const float first = a / c + static_cast<float>(k) * ulp, second = b / c + static_cast<float>(j) * ulp;
      EXPECT_TRUE(e.contains(first - second)) << k << ' ' << j;
    }
}
// A select hands on its operand with all that its terms were.
TEST(Rearranged, SumsMoveThroughASelect) {
  const float p = 1.0f, q = -1.0f, small = 0x1p-25f;
  const Enclosure e =
      under(profile_named("vulkan"), [&] { return select(true, Rearranged(p) + Rearranged(q), Rearranged(0.0f)) + Rearranged(small); });
  EXPECT_TRUE(e.contains((p + small) + q));
  EXPECT_TRUE(e.contains(std::nextafterf(1.0f, 2) + q)) << "rounded up";
}
// A flushed intermediate is multiplied by what comes after.
TEST(Rearranged, AFlushedProductIsMultiplied) {
  const float a = 1e-25f, b = 1e-25f, c = 1e30f;
  const Enclosure e = under(profile_named("vulkan"), [&] { return Rearranged(c) * Rearranged(a) * Rearranged(b); });
  EXPECT_TRUE(e.contains(0.0f)) << "(a b) c";
  EXPECT_TRUE(e.contains(a * c * b));
}
// A sum that is exact as it stands rounds once a factor has been moved into it.
TEST(Rearranged, AFactorMovedIntoAnExactSum) {
  const float p = 4096.0f, q = -4095.0f, x = 1.0f / 3.0f;
  const Enclosure e = under(profile_named("d3d"), [&] { return Rearranged(x) * (Rearranged(p) + Rearranged(q)); });
  EXPECT_TRUE(e.contains(x * p + x * q));
  EXPECT_NE(x * p + x * q, x * (p + q));
}
// Halves summed in float are exact in every order: no width.
TEST(Rearranged, OnTheGridNothingRounds) {
  const Enclosure e = under(profile_named("vulkan"), [] {
    return Rearranged(0.5f) * (Rearranged(0.25f) + Rearranged(1.375f)) - Rearranged(3.0f) * Rearranged(0x1p-10f);
  });
  EXPECT_EQ(e.lo, e.hi);
}

// ---- functions -----------------------------------------------------------------------------------------------------
// What a formula without sums and products gives is the enclosure's own.
TEST(Rearranged, FunctionsAreThoseOfEnclosures) {
  const ProfileScope scope(profile_named("vulkan"));
  const auto same = [](const Rearranged& r, const Enclosure& e) {
    EXPECT_EQ(r.settled().lo, e.lo);
    EXPECT_EQ(r.settled().hi, e.hi);
  };
  for (const float x : {0.1f, 0.7f, 1.9f}) {
    const Rearranged r(x);
    const Enclosure e(x);
    same(sqrt(r), sqrt(e));
    same(exp(r), exp(e));
    same(log(r), log(e));
    same(sin(r), sin(e));
    same(cos(r), cos(e));
    same(pow(r, Rearranged(2.2f)), pow(e, Enclosure(2.2f)));
    same(atan2(r, Rearranged(1.0f)), atan2(e, Enclosure(1.0f)));
    same(floor(r), floor(e));
    same(min(r, Rearranged(1.0f)), min(e, Enclosure(1.0f)));
    same(max(r, Rearranged(1.0f)), max(e, Enclosure(1.0f)));
  }
}
// A root of squares that nearly vanish stays bounded: no square is negative.
TEST(Rearranged, ARootOfSquaresIsNotVacuous) {
  const ProfileScope scope(profile_named("vulkan"));
  const Rearranged x = Rearranged(1.0f) - Rearranged(std::nextafterf(1.0f, 0));
  const Enclosure root = sqrt(square(x) + square(x)).settled();
  EXPECT_FALSE(root.is_vacuous());
  EXPECT_EQ(root.lo, 0.0f);
}
TEST(Rearranged, ThePolynomialOfSmoothstepEitherWay) {
  const ProfileScope scope(profile_named("vulkan"));
  for (int trial = 0; trial < 2000; ++trial) {
    const float x = static_cast<float>(uniform(-0.2, 1.2));
    const Enclosure e = smoothstep(0.0f, 1.0f, Rearranged(x)).settled();
    const float t = std::clamp(x, 0.0f, 1.0f);
    EXPECT_TRUE(e.contains(t * t * (3 - 2 * t)) && e.contains(t * (t * (3 - 2 * t))) && e.contains(3 * (t * t) - 2 * (t * t * t))) << x;
  }
}
// Of either formula, multiplied out or not.
TEST(Rearranged, MixEitherWay) {
  const ProfileScope scope(profile_named("vulkan"));
  for (int trial = 0; trial < 2000; ++trial) {
    const float a = draw(-3, 3), b = draw(-3, 3), t = static_cast<float>(uniform(0, 1));
    const Enclosure e = mix(Rearranged(a), Rearranged(b), Rearranged(t)).settled();
    for (const float got : {a * (1 - t) + b * t, a + (b - a) * t, (a - a * t) + b * t, std::fmaf(t, b, std::fmaf(-t, a, a))})
      EXPECT_TRUE(e.contains(got)) << a << ' ' << b << ' ' << t;
  }
}
TEST(Rearranged, AThresholdIsDecidedOnAllThatItMayBe) {
  const ProfileScope scope(profile_named("vulkan"));
  PathEnumeration paths;
  int above = 0;
  paths.for_each_alternative([&] {
    const Rearranged third = Rearranged(1.0f) / Rearranged(3.0f);
    above += third > Rearranged(1.0f / 3.0f);
  });
  EXPECT_EQ(paths.runs(), 2);
  EXPECT_EQ(above, 1);
}

}  // namespace
}  // namespace rainref::test
