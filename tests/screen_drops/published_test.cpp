// S1 to S6: areas, roundness, times, extents, offsets and sizes of the published drops, in closed form. Tolerances: a curve of
// radius R texels is known to 1 / R by its texels' centres.
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::pi;
using test::Published;

/// Share of a cell where sin a + sin b > tau: (1 / 2 pi^2) Int acos(clamp(tau - sin b, -1, 1)) db.
double area(double tau) {
  constexpr int steps = 200000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += std::acos(std::clamp(tau - std::sin(2 * pi * (i + 0.5) / steps), -1.0, 1.0));
  return sum / steps / pi;
}
/// The same of 2 x 2 cells of the pass, at phase phi of their cycle.
double measured(double phi, int cell = 160) {
  const Published p(2 * cell, 2 * cell, 1.0 / cell, {0.5f, static_cast<float>(phi), 0});
  int wet = 0;
  for (int y = 0; y < 2 * cell; ++y) {
    for (int x = 0; x < 2 * cell; ++x) wet += p.wet(x, y);
  }
  return wet / (4.0 * cell * cell);
}

TEST(ScreenDropsPublished, S1AreaOfADrop) {
  EXPECT_NEAR(area(0), 0.5, 1e-6);
  EXPECT_NEAR(area(0.5), 0.308312, 1e-6);
  // tau = .5 / A, A = 1 - 2 phi. 4 boundaries of about 4 x 50 texels, whose rounding averages out, and 6.28 for 2 pi: .0008.
  for (const double phi : {0.0, 0.25, 1 / 3.0}) EXPECT_NEAR(measured(phi), area(0.5 / (1 - 2 * phi)), 2e-3) << phi;
  EXPECT_EQ(measured(0.38), 0);  // A = .24 < .25
}

// A cell of 4000 texels: the drop's middle lies where both angles are pi / 2.
struct Large : Published {
  static constexpr int cell = 4000;
  int middle;
  explicit Large(double phi = 0)
      : Published(cell, cell, 1.0 / cell, {0.5f, 0.5f, 0}), middle(static_cast<int>(std::lround(cell / 4.0 * (2 * pi / 6.28) - 0.5))) {
    // The shift of both sides is 0, so the phase comes from the time: fract(t (b + .1) + .5).
    u.time = static_cast<float>((phi + 0.5) * 10);
  }
  int radius(int dx, int dy) const {
    int r = 0;
    while (wet(middle + (r + 1) * dx, middle + (r + 1) * dy)) ++r;
    return r;
  }
};
TEST(ScreenDropsPublished, S2FreshDropsAreDiamonds) {
  for (const auto& [tau, ratio] : {std::pair{0.5, 1.1235}, {1.0, 1.061}, {1.5, 1.025}}) {
    const Large p((1 - 0.5 / tau) / 2);
    const double axis = p.radius(1, 0), diagonal = p.radius(1, 1) * std::sqrt(2.0);
    EXPECT_NEAR(axis / diagonal, std::acos(tau - 1) / (std::sqrt(2.0) * std::acos(tau / 2)), 4 / diagonal);
    EXPECT_NEAR(axis / diagonal, ratio, 4 / diagonal + 5e-4);
    EXPECT_EQ(p.radius(1, 0), p.radius(0, 1));
  }
}

TEST(ScreenDropsPublished, S3ADropShowsThreeEighthsOfItsPeriod) {
  for (const float b : {0.0f, 0.25f, 1.0f}) {
    Published p(400, 400, 1.0 / 400, {0.5f, 0.5f, b});
    const double period = 1 / (b + 0.1);
    int shown = 0;
    constexpr int steps = 8000;
    for (int i = 0; i < steps; ++i) {
      p.u.time = static_cast<float>(period * i / steps);
      shown += p.wet(100, 100);
    }
    EXPECT_NEAR(shown / static_cast<double>(steps), 0.375, 3.0 / steps + 1e-3) << b;  // 1e-3: the pixel lies .5 off the middle
  }
  EXPECT_NEAR(std::log(1.1 / 0.1), 2.398, 5e-4);  // mean period of b uniform in [0, 1]
}
TEST(ScreenDropsPublished, S3MeanAreaOverAPeriod) {
  double sum = 0;
  constexpr int phases = 64;
  for (int k = 0; k < phases; ++k) sum += measured((k + 0.5) / phases, 48);
  // Of a cell of 48 texels the area is known to .002, the mean over phases to the square of 1 / 64.
  EXPECT_NEAR(sum / phases, 0.0781, 2e-3);
}
// White noise in blocks of 8 texels; cells whose lookup filters within one block. Kept cells are then binomial.
TEST(ScreenDropsPublished, S3KeepRatio) {
  constexpr int blocks = 128, side = 8 * blocks;
  const Image drawn = make_noise(5, blocks);
  std::vector<float> texels(static_cast<std::size_t>(side) * side * 4);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      float* t = &texels[(static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)) * 4];
      t[0] = to_float(drawn.row<Unorm8>(y / 8)[4 * (x / 8)]);
      t[3] = 1;
    }
  }
  const TextureData noise(texels, 4, side, side, Address::repeat, Address::repeat);
  for (int layer = 1; layer <= 4; ++layer) {
    // Layer 1 alone decides what it covers; its threshold is that of the layer asked for.
    Settings s = test::settings(Variant::as_published, 8000, 8000);
    s.grid = 0.0125;  // cells of 80 texels
    s.keep = 0.08 * (5 - layer) / 4;
    const PublishedDropsUniforms u = published_drops_uniforms(s, 0);
    int cells = 0, kept = 0;
    for (int j = 1; j < 100; ++j) {
      for (int i = 1; i < 100; ++i) {
        const double x = i / 100.0 * side / 8, y = j / 100.0 * side / 8;  // in blocks
        const double fx = x - std::floor(x), fy = y - std::floor(y);
        if (std::min({fx, fy, 1 - fx, 1 - fy}) < 0.07) continue;
        // Somewhere in the cell there is a drop at time 0, when all have their full size.
        bool found = false;
        for (int dy = 5; dy < 60 && !found; dy += 5) {
          for (int dx = 5; dx < 60 && !found; dx += 5)
            found = scalar::published_drop<test::Double>(u, noise.view(), 80 * i + dx, 80 * j + dy).layer.v == 1;
        }
        ++cells;
        kept += found;
      }
    }
    // Codes of 8 bits lie below the threshold with a probability of whole 256ths. 4 deviations: 6e-5 of false alarms.
    const double p = std::ceil(255 * 4 * s.keep) / 256;
    EXPECT_NEAR(p, 0.08 * (5 - layer), 1.0 / 256);
    EXPECT_GT(cells, 4000);
    EXPECT_NEAR(kept, cells * p, 4 * std::sqrt(cells * p * (1 - p))) << layer;
  }
}

TEST(ScreenDropsPublished, S4TheDropLiesInItsCell) {
  // Angle acos(-1/2) = 2 pi / 3 from the middle, displaced by up to 1: in cells 1/3 + 1 / 2 pi.
  EXPECT_NEAR(Large().radius(1, 0) / static_cast<double>(Large::cell), 1.0 / 3, 3.0 / Large::cell + 2e-4);
  EXPECT_LT(1.0 / 3 + 1 / (2 * pi), 0.5);
  // A whole displacement leaves no drop cut: the outline is a closed one, at n = 0 and n = 1.
  for (const float n : {0.0f, 1.0f}) {
    Published p(400, 400, 1.0 / 100, {n, n, 0});
    p.u.keep = 0.26;                           // n = 1 keeps layer 1 alone, n = 0 all of them
    const double cut = 100 * 0.25 + 50 - 0.5;  // half a cell beyond the middle of a cell
    int at_edge = 0;
    for (int y = 0; y < 400; ++y) at_edge += p.at(static_cast<int>(std::lround(cut)), y).layer.v == 1;
    EXPECT_EQ(at_edge, 0) << n;
  }
}

TEST(ScreenDropsPublished, S5OffsetAtTheContour) {
  const Large p;
  const int edge = p.middle + p.radius(1, 0);
  const auto at = p.at(edge, p.middle);
  const double shift = at.u.v - (edge + 0.5) / Large::cell;
  // .8660 / sqrt(.75 + .04) = .9743, times .3; at the right rim cos p < 0.
  EXPECT_NEAR(shift, -0.2923, 5e-4);
  EXPECT_NEAR(at.v.v, (p.middle + 0.5) / Large::cell, 3e-4);
  const auto middle = p.at(p.middle, p.middle);
  EXPECT_NEAR(middle.u.v, (p.middle + 0.5) / Large::cell, 1e-4);  // half a texel from the apex at most
}

TEST(ScreenDropsPublished, S6CellsAreSixtySevenTexelsAtEverySize) {
  for (const int width : {1280, 2560}) {
    const Published p(width, width, 0.015, {0.5f, 0, 0});
    int starts = 0, first = -1, last = -1;
    for (int x = 1; x < width; ++x) {
      if (!p.wet(x - 1, 17) && p.wet(x, 17)) {
        ++starts;
        if (first < 0) first = x;
        last = x;
      }
    }
    ASSERT_GT(starts, 10);
    EXPECT_NEAR((last - first) / (starts - 1.0), 2 * pi / (6.28 * 0.015), 1.0 / (starts - 1) + 1e-9) << width;
  }
}

}  // namespace
}  // namespace rainref::screen_drops
