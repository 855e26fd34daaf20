// The known_defects of the article that concern the drops: as-published reproduces each, corrected does not.
// Numbers are those of docs/effects/puddle.md.
#include <set>

#include <gmock/gmock.h>

#include "puddle/rainfall.h"
#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

// The pulse runs on t + .25977 i, the position on floor(t): five of ten drops jump while they are active.
TEST(PuddleKnownDefects, Defect14_DropsJumpInMidPulse) {
  struct Case {
    int drop;
    double before;  // share of the impulse that falls at the old place
  };
  const auto activation = [](double pulse) {
    return scalar::smoothstep(0.0f, 0.15f, Double(pulse)).v * scalar::smoothstep(0.35f, 0.2f, Double(pulse)).v;
  };
  for (const Case& c : {Case{1, .886}, {4, .012}, {5, .975}, {8, .078}, {9, 1}}) {
    const double at_jump = std::fmod(c.drop * 0.3711 * 0.7, 1.0);
    double before = 0, all = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double pulse = (i + 0.5) / n, a = activation(pulse) / n;
      all += a;
      if (pulse < at_jump) before += a;
    }
    EXPECT_NEAR(all, 0.2, 1e-6) << "integral of the activation";
    EXPECT_NEAR(before / all, c.before, 1e-3) << c.drop;
  }
  RaindropsUniforms u = raindrops_uniforms(as_published(1280, 720), 0);
  u.rain_speed = 1;
  u.drop_count = 10;
  u.time = 6.99999f;
  const std::vector<Drop> before = raindrops_as_published(u);
  u.time = 7;
  const std::vector<Drop> after = raindrops_as_published(u);
  std::set<int> jumping;
  for (int i = 0; i < 10; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (after[k].amplitude > 0 && std::hypot(after[k].x - before[k].x, after[k].y - before[k].y) > 1) jumping.insert(i);
  }
  EXPECT_THAT(jumping, testing::ElementsAre(1, 4, 5, 8, 9));

  // Corrected: a drop falls in one step. It is a function of the seed and the step, and the next step has others.
  Settings s = corrected_water();
  s.rain_rate = 200;
  s.smallest_drop = 0;
  const Rainfall rain(s, 1);
  int common = 0, fallen = 0;
  for (int step = 0; step < 200; ++step) {
    const std::vector<Drop> now = rain.drops(step), again = rain.drops(step), next = rain.drops(step + 1);
    ASSERT_EQ(now.size(), again.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_EQ(now[i].x, again[i].x);
      for (const Drop& d : next) common += d.x == now[i].x && d.y == now[i].y;
    }
    fallen += static_cast<int>(now.size());
  }
  EXPECT_GT(fallen, 1000);
  EXPECT_EQ(common, 0);
}

// Impulses are always positive: rain pushes the mean up, against nothing but the damping.
TEST(PuddleKnownDefects, Defect19_RainRaisesTheMean) {
  // Forced by f a step, the mean u' = gamma (2 u - p) + f rests at f / (1 - gamma).
  Settings s = as_published(48, 48);
  s.boundary = Boundary::periodic;
  s.damping = 0.95;
  Water w(s);
  const Drop drop = published_drop(24, 24, 0.3f);
  double sum = 0;
  for (int i = 0; i < 600; ++i) {
    w.step({drop});
    if (i >= 200) sum += 2 * (w.mean() - 0.5);
  }
  const double volume = 17.8285;  // of the published bump, P7
  EXPECT_NEAR(sum / 400, 0.3 * volume / (48 * 48) / (1 - 0.95), 1e-3);
  for (const Drop& d : raindrops_as_published(raindrops_uniforms(s, 17))) EXPECT_GE(d.amplitude, 0);

  // Corrected: the crater has no volume, and the mean of level water stays 0. In real arithmetic the integral of
  // (1 - q^2)^2 (1 - 4 q^2) is exactly 0; summed over texels it is below a thousandth of |A| pi R^2 from R = 4 on.
  Water level(corrected_water());
  const Drop crater{20.3f, 15.6f, -0.004f, 6};
  for (int i = 0; i < 100; ++i) level.step(i % 10 == 0 ? std::vector<Drop>{crater} : std::vector<Drop>{});
  const double share = level.mean() * 1200 / (10 * 0.004 * pi * 36);
  EXPECT_NEAR(share, 0, 1e-3);
}

// hash12 is called but not printed, and iTime is a float.
TEST(PuddleKnownDefects, Defect20_MissingHashAndFloatTime) {
  // Dave Hoskins' hash12. The pass's constants are floats; with them the evaluations agree to the bit (float) and to the
  // rounding of numbers below 2500 (double).
  const auto hash12 = [](auto x, auto y) {
    using T = decltype(x);
    const auto fract = [](T v) { return v - std::floor(v); };
    T a = fract(x * static_cast<T>(.1031f)), b = fract(y * static_cast<T>(.1031f)), c = a;
    const T shift = static_cast<T>(33.33f), d = a * (b + shift) + b * (c + shift) + c * (a + shift);
    a += d, b += d, c += d;
    return fract((a + b) * c);
  };
  for (int i = 0; i < 200; ++i) {
    const double x = i * 1.3711, y = i % 10 * 17.3;
    const float fx = static_cast<float>(x), fy = static_cast<float>(y);
    EXPECT_NEAR(scalar::hash12(Double(x), Double(y)).v, hash12(x, y), 1e-11) << x << " " << y;
    EXPECT_EQ(scalar::hash12(Single(fx), Single(fy)).v, hash12(fx, fy)) << x << " " << y;
  }
  // After 185 hours at 60 frames a second frames share their time.
  EXPECT_EQ(raindrops_uniforms(as_published(1, 1), 40'000'001).time, raindrops_uniforms(as_published(1, 1), 40'000'000).time);
  EXPECT_NE(raindrops_uniforms(as_published(1, 1), 1).time, raindrops_uniforms(as_published(1, 1), 0).time);
  // Corrected: integers of the step number, which never run out of digits.
  Settings s = corrected_water();
  s.rain_rate = 200;
  s.smallest_drop = 0;
  const Rainfall rain(s, 1);
  const std::vector<Drop> a = rain.drops(160'000'000), b = rain.drops(160'000'001);
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  EXPECT_NE(a[0].x, b[0].x);
}

// The impulse enters the new level only: it sets the water in motion instead of displacing it.
TEST(PuddleKnownDefects, Defect22_ImpulseIsAKick) {
  Water w(published_water(32, 32));
  w.step({published_drop(16, 16, 0.25f)});
  const double kick = w.mean() - 0.5;
  ASSERT_GT(kick, 0);
  for (int n = 2; n <= 40; ++n) {
    w.step();
    // Without damping the mean grows by the same amount for ever. 1024 float texels near 0.5, n steps.
    EXPECT_NEAR(w.mean() - 0.5, n * kick, 1e-7 * n) << n;
  }
  // Corrected: the crater is in both levels, so the water starts from rest.
  Water c(corrected_water());
  c.step({Drop{20, 15, -0.003f, 4}});
  EXPECT_EQ(c.now(), c.before());
  EXPECT_LT(c.now()[c.at(20, 15)], -0.002f);
}

}  // namespace
}  // namespace rainref::puddle::test
