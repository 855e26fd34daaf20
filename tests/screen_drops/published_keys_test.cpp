// The constants that the report leaves open, each as its key: what another value does, in closed form.
#include <set>

#include "screen_drops/parameters.h"
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::pi;
using test::Published;

/// Where a drop begins along row y, from x on.
int next_edge(const Published& p, int x, int y) {
  while (!(!p.wet(x - 1, y) && p.wet(x, y))) ++x;
  return x;
}

TEST(ScreenDropsPublishedKeys, DefaultsAreTheOrigins) {
  const PublishedDropsUniforms u = published_drops_uniforms(default_settings(Variant::as_published), 0);
  EXPECT_EQ(u.layers, 4);
  EXPECT_EQ(u.water_step, 0.25f);
  EXPECT_EQ(u.cell_angle, 6.28f);
  EXPECT_EQ(u.noise_middle, 0.5f);
  EXPECT_EQ(u.displacement, 2.0f);
  EXPECT_EQ(u.keep_from, 5.0f);
  EXPECT_EQ(u.keep, 0.08f);
  EXPECT_EQ(u.threshold, 0.5f);
  EXPECT_EQ(u.noise_nearest, 0);
  EXPECT_EQ(u.printed_normal, 0);
}

// Drops come every 2 pi / (cell_angle grid) pixels.
TEST(ScreenDropsPublishedKeys, CellAngleIsThePitch) {
  for (const float angle : {3.14f, 6.28f, 12.0f}) {
    Published p(4000, 40, 1.0 / 100, {0.5f, 0, 0});
    p.u.cell_angle = angle;
    const int row = static_cast<int>(std::lround(0.25 * 2 * pi / angle * 100));  // where the other sine is 1
    int first = next_edge(p, 1, row), last = first, pitches = 0;
    while (last + 300 < 4000) last = next_edge(p, last + 1, row), ++pitches;
    EXPECT_NEAR(static_cast<double>(last - first) / pitches, 2 * pi / angle * 100, 2.0 / pitches) << angle;
  }
}

// Noise n displaces a drop by (n - noise_middle) displacement / cell_angle cells, against the way that it is added.
TEST(ScreenDropsPublishedKeys, NoiseDisplacesFromItsMiddle) {
  const auto edge = [](float noise, float middle, float displacement) {
    Published p(1000, 1000, 1.0 / 400, {noise, 0, 0});
    p.u.keep = 0.2;
    p.u.layers = 1;
    p.u.noise_middle = middle;
    p.u.displacement = displacement;
    // Green is 0: the row in the drop's middle, which is displaced as well.
    const int row = static_cast<int>(std::lround((pi / 2 + middle * displacement) / 6.28 * 400));
    return next_edge(p, 1, row);
  };
  for (const float displacement : {2.0f, 0.5f})
    EXPECT_NEAR(edge(0.5f, 0.5f, displacement) - edge(0.6f, 0.5f, displacement), 0.1 * displacement / 6.28 * 400, 1.5) << displacement;
  EXPECT_NEAR(edge(0.5f, 0.5f, 1) - edge(0.5f, 0.3f, 1), 0.2 / 6.28 * 400, 1.5);
}

// Layer r lives on noise below (keep_from - r) keep, and gives water r / layers.
TEST(ScreenDropsPublishedKeys, KeepFromAndLayersChooseTheLayers) {
  const auto seen = [](int layers, float keep_from) {
    Settings s = test::settings(Variant::as_published, 64, 64);
    s.layers = layers;
    s.keep_from = keep_from;
    s.keep = 0.1;
    s.grid = 0.05;
    PublishedDropsUniforms u = published_drops_uniforms(s, 0);
    const TextureData noise(std::vector<float>{0.35f, 0, 0, 1}, 4, 1, 1, Address::repeat, Address::repeat);
    const TextureData scene(std::vector<float>{0, 0, 0, 1}, 4, 1, 1, Address::clamp, Address::clamp);
    std::set<double> water;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x)
        water.insert(
            scalar::drops_as_published<test::Double>(
                u, scene.view(), noise.view(), scalar::Vec3<test::Double>(test::Double(0.0f), test::Double(0.0f), test::Double(0.0f)), x, y)
                .water.v);
    }
    return water;
  };
  EXPECT_EQ(seen(4, 5), (std::set<double>{0, 0.25}));       // .35 < (5 - 1) .1
  EXPECT_EQ(seen(4, 6), (std::set<double>{0, 0.25, 0.5}));  // and (6 - 2) .1
  EXPECT_EQ(seen(4, 100), (std::set<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(seen(2, 100), (std::set<double>{0, 0.5, 1}));
  EXPECT_EQ(seen(1, 100), (std::set<double>{0, 1}));
  EXPECT_EQ(seen(8, 100).size(), 9u);
  EXPECT_EQ(seen(4, 1), (std::set<double>{0}));
}

// A fresh drop covers the share of its cell where sin a + sin b > threshold: (1 / 2 pi^2) Int acos(clamp(threshold - sin b, -1, 1)) db.
// A mistake that the diagnosis tries on the uniforms may say 2^30: to count that far took minutes for a few texels.
TEST(ScreenDropsPublishedKeys, MoreLayersThanThereMayBeAreNotCounted) {
  const auto picture = [](int layers) {
    Published p(40, 40, 1.0 / 7, {0.5f, 0.25f, 0});
    p.u.layers = layers;
    p.u.keep_from = 1e9f;
    std::vector<bool> wet;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) wet.push_back(p.wet(x, y));
    return wet;
  };
  EXPECT_EQ(picture(1 << 30), picture(most_published_layers));
  EXPECT_NE(picture(most_published_layers), picture(1));
}

TEST(ScreenDropsPublishedKeys, ThresholdIsTheLeastSum) {
  for (const double threshold : {0.4, 0.5, 1.0, 1.5}) {
    Published p(320, 320, 1.0 / 160, {0.5f, 0, 0});
    p.u.threshold = static_cast<float>(threshold);
    int wet = 0;
    for (int y = 0; y < 320; ++y) {
      for (int x = 0; x < 320; ++x) wet += p.wet(x, y);
    }
    double area = 0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) area += std::acos(std::clamp(threshold - std::sin(2 * pi * (i + 0.5) / steps), -1.0, 1.0)) / steps / pi;
    EXPECT_NEAR(wet / (320.0 * 320.0), area, 4e-3) << threshold;  // rims of 50 texels' radius; the row's shift of 1 cuts two of them
  }
}

// Unfiltered, the noise of texel floor(fract(u) size); a cell's three numbers are then bytes of it.
TEST(ScreenDropsPublishedKeys, NearestIsATexelOfTheNoise) {
  Settings s = test::settings(Variant::as_published, 64, 64);
  s.noise_filter = Filter::nearest;
  const PublishedDropsUniforms u = published_drops_uniforms(s, 0);
  const Image drawn = make_noise(3, 7);
  const TextureData noise(drawn, Address::repeat, Address::repeat);
  for (const double x : {0.0, 0.1, 0.5, 0.999, 1.0, 2.3, 17.9}) {
    for (const double y : {0.0, 0.4, 1.6}) {
      const auto n = scalar::published_noise<3>(u, noise.view(), test::Double(x), test::Double(y));
      const auto at = [](double a) { return static_cast<int>((a - std::floor(a)) * 7); };
      for (int k = 0; k < 3; ++k) EXPECT_EQ(n[k].v, to_float(drawn.row<Unorm8>(at(y))[4 * at(x) + k])) << x << ' ' << y;
    }
  }
}

TEST(ScreenDropsPublishedKeys, RefusedBeyondTheirRange) {
  const auto refused = [](auto change) {
    Settings s = test::settings(Variant::as_published, 16, 16);
    change(s);
    return error_of([&] { ScreenDrops(s, test::inputs(s), test::executor()); });
  };
  EXPECT_NE(refused([](Settings& s) { s.layers = 0; }).find("drops.layers"), std::string::npos);
  EXPECT_NE(refused([](Settings& s) { s.layers = 17; }).find("drops.layers: expected at most 16"), std::string::npos);
  EXPECT_NE(refused([](Settings& s) { s.threshold = 0.39; }).find("drops.threshold: expected 0.4 or more"), std::string::npos);
}

}  // namespace
}  // namespace rainref::screen_drops
