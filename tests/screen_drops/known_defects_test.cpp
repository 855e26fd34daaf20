// Each defect of the origin and of the report, by name: what as-published does, and what corrected does instead.
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::Double;
using test::pi;
using test::Pixel;
using test::Published;

/// Where the drop of cell (0, 0) begins along the row through its middle.
int left_edge(const Published& p) {
  int x = 100;
  while (p.wet(x - 1, 100)) --x;
  return x;
}

TEST(ScreenDropsKnownDefects, Defect01_PrintedDisplacementForgetsTheNoise) {
  const auto edge = [](float noise, int misprint) {
    Published p(400, 400, 1.0 / 400, {noise, 0, 0});
    p.u.keep = 0.2;
    p.u.printed_misprint = misprint;
    int x = 1;  // the first rim along a row
    while (x < 400 && p.wet(x, 64) == p.wet(x - 1, 64)) ++x;
    return x;
  };
  EXPECT_NEAR(edge(0.62f, 0) - edge(0.68f, 0), 0.12 / 6.28 * 400, 1.5);  // twice the noise, as an angle
  EXPECT_EQ(edge(0.62f, 1), edge(0.68f, 1));                             // (1 - c2) c3 is one number
  EXPECT_LT(edge(0.62f, 1), 400);
}

// The report says that drops grow, and that they dwindle; the origin lets them dwindle. Corrected they spread, then dry.
TEST(ScreenDropsKnownDefects, Defect02_DropsAppearLargeAndDwindle) {
  const auto radius = [](float phase) {
    Published p(400, 400, 1.0 / 400, {0.5f, 0.5f, 0});
    p.u.time = 10 * (phase + 0.5f);
    return 100 - left_edge(p);
  };
  EXPECT_GT(radius(0), radius(0.125f));
  EXPECT_GT(radius(0.125f), radius(0.25f));
  const CellsUniforms c = cells_uniforms(test::settings(Variant::corrected, 64, 64), {}, 0);
  const auto corrected = [&](double phase) {
    return scalar::cell_drop<test::Double>(c, test::Double(0.0f), test::Double(0.5f), test::Double(0.5f), test::Double(phase)).radius.v;
  };
  EXPECT_EQ(corrected(0), 0);
  EXPECT_NEAR(corrected(c.impact), c.largest, 1e-7);
  EXPECT_NEAR(square(test::Double(corrected(0.5 + 0.5 * c.impact))).v, 0.5 * c.largest * c.largest, 1e-7);  // the area falls evenly
}

// .3 is no index of refraction: it moves the lookup whatever the water is. Corrected, an index of 1 bends nothing.
TEST(ScreenDropsKnownDefects, Defect03_TheIndexIsAnOffset) {
  Published p(400, 400, 1.0 / 400, {0.5f, 0, 0});
  const double before = p.at(70, 100).u.v;
  p.u.refraction *= 2;
  EXPECT_NEAR(p.at(70, 100).u.v - 70.5 / 400, 2 * (before - 70.5 / 400), 1e-7);
  Pixel pixel;
  pixel.put_drop(100, 40, 0);
  EXPECT_GT(std::abs(pixel.bent()), 0.05);
  pixel.u.water_ior = 1;
  EXPECT_NEAR(pixel.bent(), 0, 1e-7);
}

// mix(.2, 2, t - .5) is asked for up to t = 2: at the apex it gives 2.9, not the 2 that stands there.
TEST(ScreenDropsKnownDefects, Defect04_TheNormalExtrapolates) {
  Published p(4000, 4000, 1.0 / 4000, {0.5f, 0.5f, 0});
  p.u.time = 5;  // phase 0
  const int middle = static_cast<int>(std::lround(1000 * 2 * pi / 6.28 - 0.5)), x = middle + 60;
  const double angle = 6.28 * (x + 0.5) / 4000, up = 6.28 * (middle + 0.5) / 4000, t = std::sin(angle) + std::sin(up),
               z = 0.2 + 1.8 * (t - 0.5);
  EXPECT_GT(z, 2.85);
  EXPECT_NEAR(p.at(x, middle).u.v - (x + 0.5) / 4000, 0.3 * std::cos(angle) / std::hypot(std::cos(angle), std::cos(up), z), 1e-6);
}

TEST(ScreenDropsKnownDefects, Defect05_SixPointTwoEightDriftsOutOfItsCell) {
  // By 5.07e-4 of a cell in each cell: .058 at cell 115.
  const Published p(4000 * 3, 40, 1.0 / 100, {0.5f, 0, 0});
  const auto middle_of = [&](int cell) {
    int a = 100 * cell + 25, b = a;
    while (p.wet(a - 1, 25)) --a;
    while (p.wet(b + 1, 25)) ++b;
    return (a + b + 1) / 200.0 - cell;
  };
  EXPECT_NEAR(middle_of(115) - middle_of(0), 115 * (2 * pi / 6.28 - 1), 0.011);  // a texel is .01
  EXPECT_NEAR(115 * (2 * pi / 6.28 - 1), 0.058, 5e-4);
  // Corrected cells are counted, not measured in angles: cell k is where floor gives k.
  const Settings s = test::settings(Variant::corrected, 1000, 100);
  const auto layers_of = make_layers(s);
  EXPECT_NEAR(layers_of[0].cells_per_pixel * 100, 20 / (cell_over_radius * s.largest_radius), 1e-12);
}

TEST(ScreenDropsKnownDefects, Defect06_SizeFollowsPixelsAndOffsetsTheAspect) {
  // Twice the picture: drops of the same number of pixels. Twice as wide: the offset in pixels doubles in x alone.
  const auto offset = [](int width, int x, int y) {
    Published p(width, 400, 1.0 / 400, {0.5f, 0.5f, 0});
    p.u.time = 5;  // a fresh drop
    const auto at = p.at(x, y);
    return std::array{(at.u.v - (x + 0.5) / width) * width, (at.v.v - (y + 0.5) / 400) * 400};
  };
  EXPECT_EQ(left_edge(Published(400, 400, 1.0 / 400, {0.5f, 0, 0})), left_edge(Published(800, 800, 1.0 / 400, {0.5f, 0, 0})));
  const auto square_picture = offset(400, 60, 60), wide = offset(800, 60, 60);
  EXPECT_NEAR(square_picture[0], square_picture[1], 1e-9);
  EXPECT_NEAR(wide[0], 2 * wide[1], 1e-9);
  // Corrected: millimetres of glass. Twice the pixels, the same share of the picture; one angle both ways at every aspect.
  Settings s = test::settings(Variant::corrected, 300, 200);
  const double before = make_layers(s)[2].cells_per_pixel;
  s.width *= 2, s.height *= 2;
  EXPECT_NEAR(make_layers(s)[2].cells_per_pixel, before / 2, 1e-12);
  const DropsUniforms u = drops_uniforms(s, make_layers(s), {0, 0});
  EXPECT_NEAR(u.scene_scale[0] * s.width, u.scene_scale[1] * s.height, 1e-3);
  EXPECT_NEAR(u.pixel[0], u.pixel[1], 1e-9);
}

TEST(ScreenDropsKnownDefects, Defect07_DropsComeBackToTheSamePlace) {
  Published p(400, 400, 1.0 / 400, {0.5f, 0.1f, 0.4f});
  p.u.time = 0;
  const int before = left_edge(p);
  for (const float periods : {1.0f, 2.0f, 40.0f}) {
    p.u.time = periods * 2;  // 1 / (b + .1)
    EXPECT_NEAR(left_edge(p), before, 1) << periods;
  }
  // Corrected: corrected_test.cpp, NoPlaceComesBackIn10000Cycles.
}

// The report calls p = sin(phase) and takes cos(p) for the normal. A cosine of a sine is at least cos 1: every drop moves the lookup to
// the right and up, however the ray meets it. The origin's cosine of the phase changes its sign at the drop's middle.
TEST(ScreenDropsKnownDefects, Defect08_TheReportTakesTheCosineOfASine) {
  Published p(400, 400, 1.0 / 400, {0.5f, 0.5f, 0});
  p.u.time = 5;  // phase 0
  const auto moved = [&](int x) { return p.at(x, 100).u.v - (x + 0.5) / 400; };
  const int left = 60, right = 139;  // the middle lies at 100 texels, of 400 to a turn
  EXPECT_GT(moved(left), 0.05);
  EXPECT_LT(moved(right), -0.05);
  p.u.printed_normal = 1;
  for (int x = left; x <= right; ++x) {
    const double phase = 6.28 * (x + 0.5) / 400, up = 6.28 * 100.5 / 400, z = 0.2 + 1.8 * (std::sin(phase) + std::sin(up) - 0.5);
    const double a = std::cos(std::sin(phase)), b = std::cos(std::sin(up));
    EXPECT_NEAR(moved(x), 0.3 * a / std::hypot(a, b, z), 1e-6) << x;
    EXPECT_GT(a, std::cos(1.0) - 1e-9);
  }
  // Corrected: as much to one side as to the other.
  Pixel at_left, at_right;
  at_left.put_drop(100, 40, 0);
  at_right.put_drop(100, -40, 0);
  EXPECT_NEAR(at_left.bent(), -at_right.bent(), 1e-6);
}

// White noise that is filtered between texels is seldom low: what a cell reads is a mean of four, wherever its place falls between them.
// P(w1 X1 + ... + w4 X4 < t) of uniform X is an alternating sum over the corners of the cube, sum (-1)^|S| (t - w(S))+^4 / (4! w1 w2 w3
// w4).
double share_below(const std::array<double, 4>& all, double t) {
  std::vector<double> w;
  for (const double x : all)
    if (x > 1e-9) w.push_back(x);
  double sum = 0, factor = 1;
  for (std::size_t k = 0; k < w.size(); ++k) factor *= static_cast<double>(k + 1) * w[k];
  for (unsigned corner = 0; corner < 1u << w.size(); ++corner) {
    double rest = t;
    int sign = 1;
    for (std::size_t k = 0; k < w.size(); ++k) {
      if ((corner >> k & 1) == 0) continue;
      rest -= w[k];
      sign = -sign;
    }
    if (rest > 0) sum += sign * std::pow(rest, static_cast<double>(w.size()));
  }
  return sum / factor;
}
TEST(ScreenDropsKnownDefects, Defect09_FilteredNoiseKeepsFewerDrops) {
  Settings s = test::settings(Variant::as_published, 1280, 720);
  s.grid = 0.015, s.keep = 0.08;
  constexpr int side = 256, seeds = 40;
  const double documented[] = {0.191, 0.095, 0.034, 0.004};
  for (int r = 1; r <= 4; ++r) {
    const double columns = 1280 * r * 0.015, rows = 720 * r * 0.015, threshold = 0.08 * (5 - r);
    double expected = 0;
    int cells = 0, kept_filtered = 0, kept = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      const TextureData noise(make_noise(static_cast<std::uint64_t>(seed), side), Address::repeat, Address::repeat);
      for (int j = 0; j < static_cast<int>(rows); ++j) {
        for (int i = 0; i < static_cast<int>(columns); ++i) {
          const double u = i / columns, v = j / rows, x = u * side + 0.5, y = v * side + 0.5, a = x - std::floor(x), b = y - std::floor(y);
          const auto red = [&](Filter filter) {
            s.noise_filter = filter;
            return scalar::published_noise<1>(published_drops_uniforms(s, 0), noise.view(), Double(u), Double(v))[0].v;
          };
          ++cells;
          kept_filtered += red(Filter::linear) < threshold;
          kept += red(Filter::nearest) < threshold;
          expected += share_below({(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b}, threshold);
        }
      }
    }
    // Bytes below a threshold: ceil(255 t) of 256; a filtered one is off by as much. Cells share few texels: 4 deviations, and half again.
    const double nearest = std::ceil(255 * threshold) / 256, filtered = expected / cells;
    EXPECT_NEAR(static_cast<double>(kept) / cells, nearest, 6 * std::sqrt(nearest / cells)) << r;
    EXPECT_NEAR(static_cast<double>(kept_filtered) / cells, filtered, 6 * std::sqrt(filtered / cells) + filtered / 128) << r;
    EXPECT_NEAR(filtered, documented[r - 1], 6e-4) << r;
  }
}

}  // namespace
}  // namespace rainref::screen_drops
