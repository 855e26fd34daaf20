// The oddities of the article that concern the water and its drops: as-published reproduces each, corrected does not.
// Numbers are those of docs/effects/puddle.md; the others are in oddities_picture_test.cpp.
#include <numeric>
#include <set>

#include <gmock/gmock.h>

#include "puddle/rainfall.h"
#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

using testing::HasSubstr;

Settings undamped(Settings s) {
  s.damping = 1;
  s.boundary = Boundary::periodic;
  return s;
}
Settings published_water(int width, int height) { return undamped(as_published(width, height)); }
Settings corrected_water() { return undamped(corrected(1, 1)); }

// A drop in the middle of texel (x, y): as published 1 at that texel, smaller further out.
Drop published_drop(float x, float y, float amplitude) { return {x + 0.5f, y + 0.5f, amplitude, 4}; }

// The comment says "remap from [-0.5, 0.5] to [0, 1]"; the code maps [-1, 1].
TEST(PuddleOddities, Oddity01_StoredUnitIsTwiceWhatTheCommentSays) {
  const Encoding published = encoding(as_published(8, 8));
  EXPECT_EQ(published.scale * 0 + published.bias, -1);
  EXPECT_EQ(published.scale * 1 + published.bias, 1);
  // An impulse of 1/2 into level water is stored as 3/4, not as 1.
  Water w(published_water(16, 16));
  w.step({published_drop(8, 8, 0.5f)});
  EXPECT_EQ(w.now()[w.at(8, 8)], 0.75f);
  // Corrected: heights are metres as they are; 8 bits span 2 cm to both sides of level water.
  const Encoding metres = encoding(corrected_water());
  EXPECT_EQ(metres.scale, 1);
  EXPECT_EQ(metres.bias, 0);
}

// "Laplacian ... subtracting the center": the published sum has no centre.
TEST(PuddleOddities, Oddity02_LaplacianHasNoCentre) {
  Water published(published_water(8, 8)), moved(published_water(8, 8));
  std::vector<float> level = published.level(0.5f);
  level[published.at(4, 4)] = 0.9f;
  moved.set(level, published.level(0.5f));
  moved.step();
  EXPECT_EQ(moved.now()[moved.at(4, 4)], 0.5f) << "the centre does not enter";
  // Corrected: its weight is (1 + gamma) (1 - 2 C^2), which is 0 only at the limit of stability.
  Settings s = corrected_water();
  Water w(s);
  std::vector<float> crest = w.level(0);
  crest[w.at(8, 8)] = 0.001f;
  w.set(crest, w.level(0));
  w.step();
  const double c = courant_number(s);
  EXPECT_NEAR(w.now()[w.at(8, 8)], 0.001 * 2 * (1 - 2 * c * c), 1e-9);  // floats of 2e-3
  EXPECT_LT(c, 0.7);
}

// The comments call s1 "left" and s2 "down"; -e.zy is down and -e.xz is left. All neighbours weigh the same and the
// sum of the first two commutes, so nothing but the names is wrong; corrected uses the same stencil.
TEST(PuddleOddities, Oddity03_SwappedNamesOfNeighboursChangeNothing) {
  const auto next = [](Water w, float down, float left, float right, float up) {
    std::vector<float> level = w.level(w.uniforms.rest);
    level[w.at(4, 3)] = down;
    level[w.at(3, 4)] = left;
    level[w.at(5, 4)] = right;
    level[w.at(4, 5)] = up;
    w.set(level, w.level(w.uniforms.rest));
    w.step();
    return w.now()[w.at(4, 4)];
  };
  // 1 swallows 2^-24 once at a time, so the order of a float sum is seen: ((s1 + s2) + s3) + s4 with s1 below.
  constexpr float tiny = 0x1p-24f;
  EXPECT_EQ(next(Water(published_water(8, 8)), 1, tiny, tiny, 0), 0.0f);
  EXPECT_EQ(next(Water(published_water(8, 8)), tiny, 1, tiny, 0), 0.0f) << "below and left commute";
  EXPECT_EQ(next(Water(published_water(8, 8)), tiny, tiny, 0, 1), 0x1p-24f) << "above is the last";
  for (const float a : {0.25f, 0.75f}) {
    const float reference = next(Water(published_water(8, 8)), a, 0.5f, 0.5f, 0.5f);
    EXPECT_EQ(next(Water(published_water(8, 8)), 0.5f, a, 0.5f, 0.5f), reference);
    EXPECT_EQ(next(Water(published_water(8, 8)), 0.5f, 0.5f, a, 0.5f), reference);
    EXPECT_EQ(next(Water(published_water(8, 8)), 0.5f, 0.5f, 0.5f, a), reference);
    const float metres = next(Water(corrected_water()), a, 0, 0, 0);
    EXPECT_EQ(next(Water(corrected_water()), 0, a, 0, 0), metres);
    EXPECT_EQ(next(Water(corrected_water()), 0, 0, 0, a), metres);
  }
}

// STEP is not defined in the article: a fraction reads between texels, and so diffuses.
TEST(PuddleOddities, Oddity04_FractionalStepReadsBetweenTexels) {
  const auto responses = [](double step) {
    Settings s = published_water(16, 16);
    s.step = step;
    Water w(s);
    std::vector<float> level = w.level(0.5f);
    level[w.at(8, 8)] = 0.75f;  // u = 1/2
    w.set(level, w.level(0.5f));
    w.step();
    const std::vector<float> now = w.now();
    std::vector<float> u;
    for (int k = 0; k < 4; ++k) u.push_back(2 * (now[w.at(8 + k, 8)] - 0.5f));
    return u;
  };
  EXPECT_THAT(responses(1), testing::ElementsAre(0, 0.25f, 0, 0));
  EXPECT_THAT(responses(2), testing::ElementsAre(0, 0, 0.25f, 0)) << "two lattices that never meet";
  EXPECT_THAT(responses(1.5), testing::ElementsAre(0, 0.125f, 0.125f, 0)) << "spread over two texels";
  // Corrected has no such parameter.
  EXPECT_THAT(error_of([] { config_of("corrected", {"puddle.step=1.5"}); }), HasSubstr("puddle.step"));
}

// The storage format is left open: 8 bits clamp and quantise, and cannot even hold level water.
TEST(PuddleOddities, Oddity05_StorageClampsAndQuantises) {
  const auto after_drop = [](Format storage, float amplitude) {
    Settings s = published_water(16, 16);
    s.storage = storage;
    Water w(s);
    w.step({published_drop(8, 8, amplitude)});
    return 2 * (w.now()[w.at(8, 8)] - 0.5f);
  };
  EXPECT_NEAR(after_drop(Format::rg16f, 3), 3, 3 * half_error);
  EXPECT_EQ(after_drop(Format::rgba8, 3), 1) << "clamped";
  Settings s = published_water(16, 16);
  s.storage = Format::rgba8;
  Water coarse(s);
  EXPECT_EQ(2 * (coarse.now()[0] - 0.5f), 128 / 255.0f * 2 - 1) << "level water lies half a code high";
  // Dead zone: a texel one code up gives its neighbours half a code less than rounding needs.
  std::vector<float> crest = coarse.level(128 / 255.0f);
  crest[coarse.at(8, 8)] = 129 / 255.0f;
  coarse.set(crest, coarse.level(128 / 255.0f));
  coarse.step();
  EXPECT_EQ(coarse.now()[coarse.at(9, 8)], 128 / 255.0f);

  // Corrected: floats of metres by default, and 8 bits are centred on level water, which stays level for ever.
  EXPECT_EQ(settings_from(config_of("corrected")).storage, Format::rg16f);
  Settings eight = corrected_water();
  eight.storage = Format::rgba8;
  eight.damping = 0.96;
  Water w(eight);
  for (int i = 0; i < 50; ++i) w.step();
  const Encoding e = encoding(eight);
  for (const float stored : w.now()) ASSERT_EQ(e.scale * static_cast<double>(stored) + e.bias, 0);
}

// smoothstep(4, .5, x) and smoothstep(.35, .2, x) have edge0 >= edge1, which GLSL leaves undefined.
TEST(PuddleOddities, Oddity06_ReversedSmoothstepIsDefinedHere) {
  const auto rising = [](double a, double b, double x) {
    const double t = std::min(1.0, std::max(0.0, (x - a) / (b - a)));
    return t * t * (3 - 2 * t);
  };
  // The formula of the specification, evaluated as it stands: one minus the rising one. Edges are floats.
  for (double r = 0; r < 5; r += 0.01) {
    EXPECT_NEAR(scalar::smoothstep(4.0f, 0.5f, Double(r)).v, 1 - rising(0.5, 4, r), 1e-12) << r;
    EXPECT_NEAR(scalar::smoothstep(0.35f, 0.2f, Double(r / 10)).v, 1 - rising(0.2, 0.35, r / 10), 1e-6) << r;
    EXPECT_NEAR(scalar::drop_as_published<Double>({0, 0, 2, 4}, Double(r), Double(0.0f)).v, 2 * (1 - rising(0.5, 4, r)), 1e-12);
  }
  // Corrected: a polynomial crater with no edge to reverse, zero from its radius on.
  const Drop crater{0, 0, -1, 3};
  EXPECT_EQ(scalar::drop_corrected(crater, Double(0.0f), Double(0.0f)).v, -1);
  EXPECT_EQ(scalar::drop_corrected(crater, Double(3.0f), Double(0.0f)).v, 0);
  EXPECT_EQ(scalar::drop_corrected(crater, Double(4.0f), Double(1.0f)).v, 0);
}

// The pulse runs on t + .25977 i, the position on floor(t): five of ten drops jump while they are active.
TEST(PuddleOddities, Oddity14_DropsJumpInMidPulse) {
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

// No dt anywhere: speed, damping and rain follow the frame rate.
TEST(PuddleOddities, Oddity17_PublishedWaterDependsOnTheFrameRate) {
  const auto one_second = [](Settings s, int fps) {
    s.fps = fps;
    auto p = std::make_unique<Puddle>(s, uniform_surroundings(1, 0.5f), executor());
    for (int i = 0; i < fps; ++i) p->simulate();
    return p;
  };
  const auto bytes = [](const Puddle& p) {
    std::vector<float> all;
    for (int y = 0; y < p.newest().height(); ++y) all.insert(all.end(), p.newest().row<float>(y), p.newest().row<float>(y) + p.newest().width());
    return all;
  };
  Settings published = as_published(24, 16);
  EXPECT_EQ(one_second(published, 30)->steps(), 30);
  EXPECT_EQ(one_second(published, 120)->steps(), 120);
  EXPECT_NE(bytes(*one_second(published, 30)), bytes(*one_second(published, 120)));
  Settings s = corrected(1, 1);
  s.rain_rate = 100;
  s.smallest_drop = 0.5;
  const auto slow = one_second(s, 30), normal = one_second(s, 60), fast = one_second(s, 120), odd = one_second(s, 50);
  EXPECT_EQ(normal->steps(), 240);
  EXPECT_NE(bytes(*normal), std::vector<float>(1200, 0.0f)) << "it rains";
  EXPECT_EQ(bytes(*slow), bytes(*normal));
  EXPECT_EQ(bytes(*fast), bytes(*normal));
  EXPECT_EQ(bytes(*odd), bytes(*normal)) << "240 / 50 is not whole";
}

// Impulses are always positive: rain pushes the mean up, against nothing but the damping.
TEST(PuddleOddities, Oddity19_RainRaisesTheMean) {
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
TEST(PuddleOddities, Oddity20_MissingHashAndFloatTime) {
  // Dave Hoskins' hash12, in double. The float reading multiplies numbers near 70 and 35: an ulp of 1.2e-4 or two,
  // and fract wraps.
  const auto hash12 = [](double x, double y) {
    const auto fract = [](double v) { return v - std::floor(v); };
    double a = fract(x * .1031), b = fract(y * .1031), c = a;
    const double d = a * (b + 33.33) + b * (c + 33.33) + c * (a + 33.33);
    a += d, b += d, c += d;
    return fract((a + b) * c);
  };
  for (int i = 0; i < 200; ++i) {
    const double x = i * 1.3711, y = i % 10 * 17.3;
    const double expected = hash12(x, y), got = scalar::hash12(Single(static_cast<float>(x)), Single(static_cast<float>(y))).v;
    const double apart = std::abs(expected - got);
    EXPECT_LT(std::min(apart, 1 - apart), 5e-3) << x << " " << y;
    EXPECT_NEAR(scalar::hash12(Double(x), Double(y)).v, expected, 2e-2) << "constants are floats";
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
TEST(PuddleOddities, Oddity22_ImpulseIsAKick) {
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

// The damping factor acts on the level, not on its change: it pulls the mean to 0 and makes it ring.
TEST(PuddleOddities, Oddity23_DampingRingsTheMean) {
  Settings s = as_published(8, 8);
  s.damping = 0.95;
  s.boundary = Boundary::periodic;
  Water w(s);
  w.set(w.level(0.75f), w.level(0.75f));
  // z^2 - 2 gamma z + gamma = 0: cos(w0) = sqrt(gamma), period 27.9 steps, decay sqrt(gamma) a step.
  EXPECT_NEAR(2 * pi / std::acos(std::sqrt(0.95)), 27.9, 0.05);
  double now = 0.5, before = 0.5, lowest = 0;
  for (int n = 1; n <= 60; ++n) {
    w.step();
    const double next = 0.95 * (2 * now - before);
    before = now;
    now = next;
    EXPECT_NEAR(2 * (w.mean() - 0.5), now, 1e-5) << n;  // float storage, 60 steps
    lowest = std::min(lowest, now);
  }
  EXPECT_LT(lowest, -0.3);
  // Corrected: a raised level stays, bit for bit, whatever the damping.
  Settings c = corrected(1, 1);
  c.damping = 0.9;
  c.boundary = Boundary::periodic;
  Water high(c);
  high.set(high.level(0.0123f), high.level(0.0123f));
  for (int n = 0; n < 60; ++n) high.step();
  EXPECT_EQ(high.now(), high.level(0.0123f));
}

}  // namespace
}  // namespace rainref::puddle::test
