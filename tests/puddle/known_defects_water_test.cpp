// The known_defects of the article that concern the water: as-published reproduces each, corrected does not.
// Numbers are those of docs/effects/puddle.md.
#include <algorithm>

#include <gmock/gmock.h>

#include "image/images.h"
#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

using testing::HasSubstr;

// The comment says "remap from [-0.5, 0.5] to [0, 1]"; the code maps [-1, 1].
TEST(PuddleKnownDefects, Defect01_StoredUnitIsTwiceWhatTheCommentSays) {
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
TEST(PuddleKnownDefects, Defect02_LaplacianHasNoCentre) {
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
TEST(PuddleKnownDefects, Defect03_SwappedNamesOfNeighboursChangeNothing) {
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
TEST(PuddleKnownDefects, Defect04_FractionalStepReadsBetweenTexels) {
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
TEST(PuddleKnownDefects, Defect05_StorageClampsAndQuantises) {
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
TEST(PuddleKnownDefects, Defect06_ReversedSmoothstepIsDefinedHere) {
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

// No dt anywhere: speed, damping and rain follow the frame rate.
TEST(PuddleKnownDefects, Defect17_PublishedWaterDependsOnTheFrameRate) {
  const auto one_second = [](Settings s, int fps) {
    s.fps = fps;
    auto p = std::make_unique<Puddle>(s, uniform_surroundings(1, 0.5f), executor());
    for (int i = 0; i < fps; ++i) p->simulate();
    return p;
  };
  const auto bytes = [](const Puddle& p) { return bytes_of(p.newest()); };
  Settings published = as_published(24, 16);
  EXPECT_EQ(one_second(published, 30)->steps(), 30);
  EXPECT_EQ(one_second(published, 120)->steps(), 120);
  EXPECT_NE(bytes(*one_second(published, 30)), bytes(*one_second(published, 120)));
  Settings s = corrected(1, 1);
  s.rain_rate = 100;
  s.smallest_drop = 0.5;
  const auto normal = one_second(s, 60), odd = one_second(s, 50);  // other rates: WaveRate
  EXPECT_EQ(normal->steps(), 240);
  EXPECT_NE(bytes(*normal), std::string(bytes(*normal).size(), '\0')) << "it rains";
  EXPECT_EQ(bytes(*odd), bytes(*normal)) << "240 / 50 is not whole";
}

// The damping factor acts on the level, not on its change: it pulls the mean to 0 and makes it ring.
TEST(PuddleKnownDefects, Defect23_DampingRingsTheMean) {
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
