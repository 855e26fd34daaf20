// The corrected window against closed forms: circles, Snell's law, areas, sizes, and cycles that never come back.
#include <algorithm>
#include <map>
#include <set>

#include "pass/same_as_definition.h"
#include "screen_drops/info.h"
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::Double;
using test::pi;
using test::Pixel;

TEST(ScreenDropsCorrected, DropsAreRound) {
  Pixel p;
  p.put_drop(300, 0, 0);
  // A pixel is half covered where its centre lies on the rim.
  const auto covered_to = [&](double dx, double dy) {
    double r = 0;
    int k = 0;
    for (; p.at(Pixel::middle + static_cast<int>(k * dx), Pixel::middle + static_cast<int>(k * dy)).water.v >= 0.5; ++k)
      r = std::hypot(static_cast<int>(k * dx), static_cast<int>(k * dy));
    return r;
  };
  EXPECT_NEAR(covered_to(1, 0), 300, 1);
  EXPECT_NEAR(covered_to(0, -1), 300, 1);
  EXPECT_NEAR(covered_to(1, 1), 300, std::sqrt(2.0));
  EXPECT_NEAR(covered_to(-5, 12), 300, 13);
  double area = 0;
  for (int y = -302; y <= 302; ++y) {
    for (int x = -302; x <= 302; ++x) area += p.at(Pixel::middle + x, Pixel::middle + y).water.v;
  }
  EXPECT_NEAR(area, pi * (300 * 300 + 1 / 12.0), 8);  // covers of 1900 pixels of the rim, each off by .05 or so
}

// On the axis of the view: asin(n r / rho) - asin(r / rho), rho = R / sin a, toward the drop's middle.
TEST(ScreenDropsCorrected, SnellThroughACap) {
  for (const double offset : {20.0, 60.0, 100.0}) {
    Pixel p;
    p.u.sine = 0.5f;
    p.put_drop(120, -offset, 0);  // the pixel lies to the right of its middle, and looks to the left
    const double lean = offset * 0.5 / 120;
    // The ramp is bilinear in 64 texels, exact within them but for floats.
    EXPECT_NEAR(p.bent(), -(std::asin(1.333 * lean) - std::asin(lean)), 2e-6) << offset;
  }
  Pixel p;
  p.put_drop(120, 0, 0);
  EXPECT_NEAR(p.bent(), 0, 1e-7);
}
// Beyond 1 / n there is total reflection: the dark rim of drops steeper than 48.6 degrees.
TEST(ScreenDropsCorrected, TheRimOfASteepDropMirrors) {
  Pixel p;
  p.u.sine = 0.9f;
  p.put_drop(100, -84.5, 0);  // lean .7605 > 1 / 1.333
  EXPECT_NEAR(p.at(Pixel::middle, Pixel::middle).colour.y.v, p.u.inner * 0.5, 1e-7);
  Pixel q;
  q.u.sine = 0.9f;
  q.put_drop(100, -82.5, 0);  // .7425 <
  EXPECT_GT(std::abs(q.at(Pixel::middle, Pixel::middle).colour.y.v - p.u.inner * 0.5), 0.02);
}
TEST(ScreenDropsCorrected, DryGlassIsTheBackgroundToTheBit) {
  const Pixel p;
  const auto w = p.at(77, 1900);
  EXPECT_EQ(w.water.v, 0);
  EXPECT_EQ(w.colour.x.v, 0.25);
  EXPECT_EQ(w.colour.z.v, 0.75);
}
TEST(ScreenDropsCorrected, CoarserDropsLieOverFinerOnes) {
  Pixel p;
  p.put_drop(120, -40, 0, 0);
  const double alone = p.bent();
  p.put_drop(60, 30, 0, 2);
  EXPECT_EQ(p.bent(), alone);
}

// A paraboloid of water h = H (1 - q^2) on the flowing layer: central differences are exact there. sin out = n sin a, a = atan h'.
TEST(ScreenDropsCorrected, FlowingWaterBendsByItsSlope) {
  Pixel p;
  constexpr int texels = 401;
  const double height = 60, radius = 160;  // in texels of flow: a side of the picture is 2001 mm
  const double mm = 2001.0 / texels;
  std::vector<float> h;
  for (int y = 0; y < texels; ++y) {
    for (int x = 0; x < texels; ++x) {
      const double dx = x - 200 + 50, dy = y - 200;
      h.push_back(static_cast<float>(std::max(0.0, height * (1 - (dx * dx + dy * dy) / (radius * radius)))));
    }
  }
  p.height = TextureData(h, 1, texels, texels, Address::clamp, Address::clamp);
  p.u = drops_uniforms(p.s, make_layers(p.s), {texels, texels});
  p.u.flow_level = 0;
  p.put_drop(300, 100, 0);  // what lies below does not count
  const double slope = 2 * height * 50 / (radius * radius) / mm, a = std::atan(slope);
  // Heights are floats of 60: a difference of 2^-18 over 10 mm.
  EXPECT_NEAR(p.bent(), -(std::asin(1.333 * std::sin(a)) - a), 2e-6);
  EXPECT_NEAR(p.at(Pixel::middle, Pixel::middle).water.v, 1, 1e-12);
  p.u.has_flow = 0;
  EXPECT_GT(p.bent(), 0.01);  // the drop whose middle lies to the right
}

// ---- cells -----------------------------------------------------------------------------------------------------------
CellsUniforms uniforms(const Settings& s, int frame) { return cells_uniforms(s, make_layers(s), frame); }

TEST(ScreenDropsCells, DropsStayInsideTheirCells) {
  const Settings s = test::settings(Variant::corrected, 400, 400);
  const CellsUniforms u = uniforms(s, 7);
  for (const double size : {0.0, 0.3, 1.0}) {
    for (const double place : {0.0, 0.5, 65535.0 / 65536}) {
      const auto d = scalar::cell_drop<Double>(u, Double(size), Double(place), Double(1 - place), Double(s.impact));
      EXPECT_GE(d.x.v - d.radius.v, -1e-7);
      EXPECT_LE(d.x.v + d.radius.v, 1 + 1e-7);
      EXPECT_LE(d.y.v + d.radius.v, 1 + 1e-7);
      EXPECT_NEAR(d.radius.v, 0.4 / std::sqrt(1 + 3 * size), 1e-6);
    }
  }
}
// Density ~ R^-3: N(> R) = (R^-2 - largest^-2) / 3 largest^-2. Classes of equal probability; chi-square of 9 degrees beyond 33.7
// once in 10^4.
TEST(ScreenDropsCells, RadiiFollowThePowerLaw) {
  Settings s = test::settings(Variant::corrected, 900, 900);
  s.pane_height = 0.9;
  s.share = 1;
  const CellsUniforms u = uniforms(s, 100);
  std::array<int, 10> classes{};
  int count = 0;
  for (int y = 0; y < u.rows[0]; ++y) {
    const CellLine line(u, y);
    for (int x = 0; x < u.columns[0]; ++x) {
      const CellState c = line.at(x);
      const double r =
          scalar::cell_drop<Double>(u, Double(c.size / 65536.0), Double(0.5f), Double(0.5f), Double(s.impact)).radius.v / u.largest;
      ++classes[std::min<std::size_t>(9, static_cast<std::size_t>((1 / (r * r) - 1) / 3 * 10))];
      ++count;
    }
  }
  ASSERT_GT(count, 5000);
  double chi = 0;
  for (const int n : classes) chi += (n - count / 10.0) * (n - count / 10.0) / (count / 10.0);
  EXPECT_LT(chi, 33.7);
}
// Of a layer: share . pi largest^2 . E[1 / (1 + 3 u)] = ln 4 / 3 . E[share of the area] = 1 / 2. No cell's area is beyond
// pi .16 = .5027, so its deviation is at most half of that: 4 of them, by the root of the number of cells.
TEST(ScreenDropsCells, CoverageIsTheClosedForm) {
  Settings s = test::settings(Variant::corrected, 600, 600);
  s.pane_height = 0.6;
  s.share = 0.7;
  const auto grids = make_layers(s);
  const auto size = cells_size(grids);
  Image cells(Format::rgba32f, size[0], size[1]);
  test::fill_cells(cells_uniforms(s, grids, 37), cells);
  for (const Layer& layer : grids) {
    double area = 0;
    for (int y = 0; y < layer.rows; ++y) {
      for (int x = 0; x < layer.columns; ++x) area += pi * std::pow(cells.row<float>(layer.first_row + y)[4 * x + 2], 2);
    }
    const double count = layer.rows * layer.columns;
    EXPECT_NEAR(area / count, s.share * pi * 0.16 * std::log(4.0) / 3 / 2, 4 * 0.2514 / std::sqrt(count));
  }
}
// The picture of it: layers are independent, and a pixel's cover adds pi / 12 to the area of a disc of pixels.
TEST(ScreenDropsCells, LayersCoverIndependently) {
  Settings s = test::settings(Variant::corrected, 500, 500);
  s.pane_height = 0.1;
  ScreenDrops window(s, test::inputs(s), test::executor());
  window.next_frame();
  const auto grids = make_layers(s);
  double dry = 1, wet = 0;
  for (const Layer& layer : grids) {
    double area = 0;
    for (int y = 0; y < layer.rows; ++y) {
      for (int x = 0; x < layer.columns; ++x) {
        const double radius = window.cells().row<float>(layer.first_row + y)[4 * x + 2];
        if (radius > 0) area += pi * radius * radius + pi / 12 * layer.cells_per_pixel * layer.cells_per_pixel;
      }
    }
    dry *= 1 - area / (layer.rows * layer.columns);
  }
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) wet += to_float(window.water().row<Unorm8>(y)[x]);
  }
  // 11 x 11 cells of the coarsest layer, some beyond the picture's edge: a share of 1/10 of its .07, and chance overlaps.
  EXPECT_NEAR(wet / (500.0 * 500), 1 - dry, 0.015);
}
// A cell that keeps what it drew gives what one does that draws anew: through its cycles, over the end of the clock, and back in time.
TEST(ScreenDropsCells, KeptDrawsAreFreshDraws) {
  Settings s = test::settings(Variant::corrected, 400, 400);
  CellsUniforms u = uniforms(s, 0);
  const CellLine line(u, 3);
  std::vector<DrawnCell> drawn(static_cast<std::size_t>(u.columns[0]) + 1);
  std::vector<std::uint32_t> ticks;
  for (std::uint32_t k = 0; k < 400; ++k) ticks.push_back(k * 33);
  for (std::uint32_t k = 0; k < 400; ++k) ticks.push_back(0xffffffffu - 6000 + k * 33);
  ticks.insert(ticks.end(), {5, 3000, 0x80000000u, 3033});
  std::set<std::uint32_t> cycles;
  for (const std::uint32_t tick : ticks) {
    u.tick = tick;
    for (int x = 0; x <= u.columns[0]; ++x) {
      const CellState kept = line.at(x, drawn[static_cast<std::size_t>(x)]), fresh = line.at(x);
      ASSERT_EQ(std::tie(kept.holds_drop, kept.cycle, kept.phase, kept.size, kept.x, kept.y),
                std::tie(fresh.holds_drop, fresh.cycle, fresh.phase, fresh.size, fresh.x, fresh.y))
          << tick << ", cell " << x;
      cycles.insert(kept.cycle);
    }
  }
  EXPECT_GT(cycles.size(), 20u);
}
// The rows that keep what cells drew, against the definition, which draws every cell anew.
TEST(ScreenDropsCells, RowsAreAsDefined) {
  for (const int width : {17, 64, 133}) {
    ScreenDrops window(test::settings(Variant::corrected, width, 40), test::inputs(test::settings(Variant::corrected, width, 40)),
                       test::executor());
    const auto cases = rainref::test::captured(effect_info(), true, "cells", [&](Recorder& recorder) {
      for (int frame = 0; frame < 40; ++frame) window.next_frame(&recorder);
    });
    ASSERT_EQ(cases.size(), 40u);
    ASSERT_TRUE(rainref::test::are_as_defined(cases, evaluations())) << width;
  }
}
TEST(ScreenDropsCells, EveryCellHasAPeriodOfItsOwn) {
  Settings s = test::settings(Variant::corrected, 400, 400);
  s.pane_height = 0.1;
  CellsUniforms u = uniforms(s, 0);
  std::map<int, int> lengths;
  const CellLine line(u, 3);
  for (int x = 0; x < u.columns[0]; ++x) {
    // From one whole cycle to the next.
    std::vector<std::uint32_t> starts;
    std::uint32_t before = 0;
    for (u.tick = 0; u.tick < 7000 && starts.size() < 2; ++u.tick) {
      const std::uint32_t cycle = line.at(x).cycle;
      if (u.tick > 0 && cycle != before) starts.push_back(u.tick);
      before = cycle;
    }
    ASSERT_EQ(starts.size(), 2u);
    const int length = static_cast<int>(starts[1] - starts[0]);
    EXPECT_GE(length, 200);
    EXPECT_LE(length, 3000);
    ++lengths[length];
  }
  EXPECT_GE(lengths.size(), static_cast<std::size_t>(u.columns[0]) - 1);
}

// 10^4 cycles of a cell. Places have 2 x 16 bits, so that of N = 10^4 independent ones N^2 / 2^33 = .0116 pairs agree: two or
// more do so with probability 6.7e-5 (Poisson). Neighbouring cycles are no nearer than chance: the mean of |dx| of uniform places
// is 1/3 with deviation sqrt(1/18 (1 + ...)) / sqrt(N), taken as .3 / 100; 5 of them: 6e-7. Classes 10 x 10: chi-square of 99
// degrees beyond 161 once in 10^4. Together a right generator fails in 2e-4 of seeds; this seed is fixed, so that it never does.
TEST(ScreenDropsCells, NoPlaceComesBackIn10000Cycles) {
  Settings s = test::settings(Variant::corrected, 64, 64);
  s.shortest_cycle = s.longest_cycle = 0.4;
  s.share = 1;
  CellsUniforms u = uniforms(s, 0);
  constexpr int cycles = 10000;
  std::set<std::uint64_t> places;
  std::array<int, 100> classes{};
  double apart = 0;
  CellState before{};
  for (int k = 0; k < cycles; ++k) {
    u.tick = static_cast<std::uint32_t>(k) * 400;
    const CellState c = CellLine(u, 1).at(1);
    ASSERT_EQ(c.cycle, static_cast<std::uint32_t>(k));
    places.insert(static_cast<std::uint64_t>(c.x) << 16 | c.y);
    ++classes[c.x * 10 / 65536 * 10 + c.y * 10 / 65536];
    if (k > 0) apart += std::abs(static_cast<double>(c.x) - before.x) / 65536;
    before = c;
  }
  EXPECT_GE(places.size(), cycles - 1u);
  EXPECT_NEAR(apart / (cycles - 1), 1.0 / 3, 5 * 0.3 / 100);
  double chi = 0;
  for (const int n : classes) chi += (n - 100.0) * (n - 100.0) / 100;
  EXPECT_LT(chi, 161);
}

TEST(ScreenDropsBackground, IsTheMeanOverADisc) {
  Settings s = test::settings(Variant::corrected, 64, 48);
  s.defocus = 0.1;
  double x = 0, y = 0, square_sum = 0;
  for (const Tap& t : make_taps(s)) {
    const double px = t.x * s.width / s.height, py = t.y, radius = s.defocus / s.scene_margin;
    x += px / radius / 24;
    y += py / radius / 24;
    square_sum += (px * px + py * py) / (radius * radius) / 24;
  }
  EXPECT_NEAR(square_sum, 0.5, 1e-6);  // of a disc: r^2 / 2
  EXPECT_NEAR(x, 0, 0.05);
  EXPECT_NEAR(y, 0, 0.05);
  // A constant stays, to half a code of the halves.
  Inputs in;
  in.colour = Image(Format::rgba32f, 64, 48);
  for (int row = 0; row < 48; ++row) std::fill_n(in.colour.row<float>(row), 4 * 64, 0.75f);
  ScreenDrops window(s, in, test::executor());
  window.next_frame();
  for (int row = 0; row < 48; ++row) {
    for (int i = 0; i < 64; ++i) ASSERT_NEAR(to_float(window.background().row<Half>(row)[4 * i]), 0.75, 0x1p-11);
  }
}

}  // namespace
}  // namespace rainref::screen_drops
