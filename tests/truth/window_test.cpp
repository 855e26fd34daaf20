// The traced window of screen_drops and the traced pane of rainy_glass: what both must show, and where the passes must agree.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "image/images.h"
#include "truth/rainy_glass_view.h"
#include "truth/screen_drops_view.h"
#include "compositor/shading_support.h"
#include "compositor/straight_path.h"
#include "night_street/night_street.h"
#include "rainref/error.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/host.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"
#include "settings.h"

namespace rainref::truth {
namespace {

const parallel::Executor& executor() {
  static const parallel::Executor two(2);
  return two;
}
/// The share of light that a dry pane of this index lets through at this angle, all mirror images added (Stokes).
double through_pane(double angle, double n) {
  const double r = testing::fresnel(angle, n);
  return (1 - r) / (1 + r);
}

// ---- screen_drops ---------------------------------------------------------------------------------------------------
struct Window {
  screen_drops::Settings s;
  screen_drops::Inputs in;
  Window() {
    s.width = 96;
    s.height = 64;
    s.pane_height = 0.05;
    s.camera_position = {2.2, 1.7, 12};
    s.camera_target = {0.6, 1.9, -20};
    s.defocus = 0;
  }
  void fill() {
    in.colour = make_image(Format::rgba32f, s.width, s.height,
                           [](int x, int y, int c) { return static_cast<float>(0.05 + 0.01 * (((4 * x + c) * 7 + y * 13) % 97)); });
  }
  Comparison truth(double thickness) {
    fill();
    screen_drops::ScreenDrops drops(s, in, executor());
    drops.next_frame();
    return ScreenDropsView(s, in.colour, thickness, {}, executor()).compare(drops, {}, executor());
  }
};
std::size_t pixels(const Comparison& truth, const std::string& name) {
  for (const auto& [key, count] : truth.pixels) {
    if (key == name) return count;
  }
  ADD_FAILURE() << name;
  return 0;
}

// A dry pane shows the passes' background, less what glass mirrors: 1 - t of it, at every angle.
TEST(TracedWindow, DryPaneShowsTheScene) {
  Window w;
  w.s.share = 0;
  w.s.scene_margin = 1;  // the scene's texels are the picture's pixels
  w.fill();
  screen_drops::ScreenDrops drops(w.s, w.in, executor());
  drops.next_frame();
  const ScreenDropsView view(w.s, w.in.colour, 5e-3, {}, executor());
  PictureOptions options;
  options.shading = {40, 1e-12};
  const Picture traced = trace_picture(*view.scene(drops), view.camera(), w.s.width, w.s.height, options, executor());
  const PrimaryRays primary(view.camera(), w.s.width, w.s.height);
  for (int y = 0; y < w.s.height; ++y) {
    for (int x = 0; x < w.s.width; ++x) {
      const Vec d = primary.through(x + 0.5, y + 0.5).direction;
      const double t = through_pane(std::acos(1 / std::sqrt(dot(d, d))), 1.52);
      for (int k = 0; k < 3; ++k) {
        const double passes = to_float(drops.colour().row<Half>(y)[4 * x + k]), rays = to_float(traced.beauty.row<Half>(y)[4 * x + k]);
        ASSERT_NEAR(rays, t * passes, 0x1p-10 * passes) << x << " " << y;  // a half's rounding on either side
      }
    }
  }
}

// Where drops are shallow and the pane is thin there is no parallax to miss: the pass's two refractions are those of the rays.
TEST(TracedWindow, ShallowDropsAreAsThePassHasThem) {
  Window w;
  w.s.width = 240;
  w.s.height = 160;
  w.s.contact_angle_deg = 2;
  w.s.largest_radius = 20;  // 64 pixels; the smallest drops 4
  const Comparison truth = w.truth(1e-5);
  EXPECT_GT(pixels(truth, "drop_pixels"), 1000u);
  EXPECT_LT(100 * (pixels(truth, "drop_not_wet") + pixels(truth, "wet_not_drop")),
            pixels(truth, "drop_pixels"));  // centres that the rim meets
  EXPECT_EQ(pixels(truth, "mirrored_pixels"), 0u);
  const Percentiles p = truth.differences[0].percentiles();
  // A lens of 2 degrees turns rays by up to (n - 1) 2 = 0.67. Where they run on in it for its height, at 20 degrees, they miss
  // (n - 1) a^2 / 2 tan 20 / n = 0.003 degrees. Where two drops overlap the pass shows the coarser one and the rays the higher: twice 0.67,
  // and up to a tenth more at a slant.
  EXPECT_LT(p.p50, 0.003);
  EXPECT_LT(p.max, 1.48);
}

TEST(TracedWindow, RefusesWhatItCannotTrace) {
  Window w;
  w.fill();
  EXPECT_THROW(ScreenDropsView(w.s, w.in.colour, 0.1, {}, executor()), Error);  // the eye is 0.09 m away
  w.s.variant = Variant::as_published;
  EXPECT_THROW(ScreenDropsView(w.s, w.in.colour, 1e-3, {}, executor()), Error);
}

// ---- rainy_glass ----------------------------------------------------------------------------------------------------
struct Conservatory {
  rainy_glass::Settings s = rainref::test::rainy_glass_settings();
  std::shared_ptr<const scene::Scenery> street = night_street::Street::make({s.seed});
  rainy_glass::Surroundings around;
  std::optional<rainy_glass::RainyGlass> glass;
  Conservatory() {
    s.width = 96;
    s.height = 64;
    s.map_size = 128;
    s.largest_droplet = 0.08;
    s.smallest_droplet = 0.04;
    s.droplet_count = 40;
    s.trail_count = 0;
    s.rain_amount = 1;
    s.camera_position = {2.2, 1.7, 12};
    s.camera_target = {0.6, 1.9, -20};
  }
  void render(double bars = 0) {
    around = rainy_glass::make_backdrop(s, {0.01, bars, 0.03}, *street, executor());
    glass.emplace(s, around, executor());
    for (int frame = 0; frame < 20; ++frame) glass->next_frame();
  }
  RainyGlassView view(double thickness) const {
    return {s, around, RainyGlassView::Street{street, rainy_glass::make_backdrop(s, {0.01, 0, 0.03}, *street, executor())}, thickness, {}};
  }
};

TEST(TracedGlass, DryPaneShowsTheScene) {
  Conservatory c;
  c.s.droplet_count = 0;
  c.render();
  const RainyGlassView view = c.view(1e-5);
  PictureOptions options;
  options.shading = {40, 1e-12};
  const Picture traced = trace_picture(*view.scene(*c.glass), view.camera(), c.s.width, c.s.height, options, executor());
  const PrimaryRays primary(view.camera(), c.s.width, c.s.height);
  const Vec n = view.pane().normal(0);
  for (int y = 0; y < c.s.height; ++y) {
    for (int x = 0; x < c.s.width; ++x) {
      const Vec d = primary.through(x + 0.5, y + 0.5).direction;
      const double t = through_pane(std::acos(dot(d, n) / std::sqrt(dot(d, d))), 1.52);
      for (int k = 0; k < 3; ++k) {
        const double passes = to_float(c.glass->colour().row<Half>(y)[4 * x + k]), rays = to_float(traced.beauty.row<Half>(y)[4 * x + k]);
        // Two halves, and 10 um of glass half a metre away: a thousandth of a pixel.
        ASSERT_NEAR(rays, t * passes, 0x1p-10 * passes + 2e-3) << x << " " << y;
      }
    }
  }
}

// A ray along the normal leaves water of slope tan a at asin(n sin a) - a, whatever lies before it.
TEST(TracedGlass, BendsBySnellsLaw) {
  Conservatory c;
  c.s.yaw_deg = 15;
  c.s.contact_angle_deg = 60;
  c.render();
  const RainyGlassView view = c.view(5e-3);
  const auto scene = view.scene(*c.glass);
  const rainy_glass::ShownGlass shown(c.s, c.around, *c.glass);
  const Pane& pane = view.pane();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> in(0.1, 0.9);
  int wet = 0, mirrored = 0;
  for (int i = 0; i < 5000; ++i) {
    const double u = in(random), v = in(random);
    const RainyGlassView::Spot spot = view.spot(u, v);
    const auto slope = shown.slope(spot.u, spot.v, pane.normal(0));
    const StraightPath path = straight_path(*scene, {pane.point(u, v, -0.02), pane.normal(0)});
    const double a = std::atan(std::hypot(slope.u, slope.v));
    if (!slope.is_wet) {
      ASSERT_EQ(path.interfaces, 2);
      ASSERT_GT(dot(path.direction, pane.normal(0)), 1 - 1e-15);
      continue;
    }
    ++wet;
    // The ray's place has a few roundings, and slopes change with it by some 1e-13; near the critical angle the exit multiplies that by
    // n / cos, up to 3e4 here.
    if (std::abs(1.333 * std::sin(a) - 1) < 1e-9) continue;
    if (1.333 * std::sin(a) > 1) {
      ++mirrored;
      ASSERT_EQ(path.end, StraightPath::End::mirrored);
      continue;
    }
    const double expected = std::asin(1.333 * std::sin(a)) - a;
    const Vec aside = path.direction - dot(path.direction, pane.normal(0)) * pane.normal(0);
    ASSERT_NEAR(std::asin(std::sqrt(dot(aside, aside))), expected, 1e-8) << a;
    // Toward the thicker side: up the slope.
    const Vec up_slope = slope.u * pane.shape().e_u / std::sqrt(dot(pane.shape().e_u, pane.shape().e_u)) + slope.v * Vec(0, 1, 0);
    if (a > 1e-3) {
      ASSERT_GT(dot(aside, up_slope), 0);
    }
  }
  EXPECT_GT(wet, 300);
  EXPECT_GT(mirrored, 10);
}

// Gentle slopes, a thin pane and a narrow view are what the thin prism is made for.
TEST(TracedGlass, GentleSlopesAreAsThePassHasThem) {
  Conservatory c;
  c.s.contact_angle_deg = 3;
  c.s.vertical_fov_deg = 12;
  c.s.drop_tile = 0.1;
  c.render();
  const Comparison truth = c.view(1e-5).compare(*c.glass, {}, executor());
  EXPECT_GT(pixels(truth, "wet_pixels"), 300u);
  const Percentiles p = truth.differences[0].percentiles();
  // (n - 1) tan 3 = 1.0 degree at the rims; off the axis the image plane shortens it by sin^2 of up to 10 degrees, 3 %, and the
  // depth at the pixel is not quite that of the place, 0.5 m of 10 m and more.
  EXPECT_LT(p.p50, 0.03);
  EXPECT_LT(p.p99, 0.08);
}

// Bars stand before the glass, for rays as for the passes.
TEST(TracedGlass, WhatStandsBeforeTheGlassIsSeenAsItIs) {
  Conservatory c;
  c.s.droplet_count = 0;
  c.render(0.2);
  const RainyGlassView view = c.view(5e-3);
  const Picture traced = trace_picture(*view.scene(*c.glass), view.camera(), c.s.width, c.s.height, {}, executor());
  int bars = 0;
  for (int y = 0; y < c.s.height; ++y) {
    for (int x = 0; x < c.s.width; ++x) {
      if (std::as_const(c.around.depth).row<float>(y)[x] > c.glass->surface().row<float>(y)[4 * x + 2]) continue;
      ++bars;
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(to_float(traced.beauty.row<Half>(y)[4 * x + k]), to_float(c.glass->colour().row<Half>(y)[4 * x + k]));
    }
  }
  EXPECT_GT(bars, 200);
}

TEST(TracedGlass, RefusesWhatItCannotTrace) {
  Conservatory c;
  c.render();
  EXPECT_THROW(c.view(0.5), Error);
  c.s.shape = rainy_glass::Shape::sphere;
  EXPECT_THROW(c.view(1e-3), Error);
}

}  // namespace
}  // namespace rainref::truth
