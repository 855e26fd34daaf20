// Windows with caps of water, and glass with water of given slopes, against the laws of optics in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compositor/cap_water.h"
#include "compositor/rainy_glass_truth.h"
#include "compositor/screen_drops_truth.h"
#include "compositor/shading_support.h"
#include "compositor/straight_path.h"
#include "rainref/error.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/host.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"

namespace rainref::compositor {
namespace {

using testing::radians;

const parallel::Executor& executor() {
  static const parallel::Executor two(2);
  return two;
}
/// 40 mm x 30 mm in the plane z = 0, outward +z.
Pane pane(double thickness = 5e-3) { return Pane({{0, 0, 0}, {0.04, 0, 0}, {0, 0.03, 0}, {0, 0, 1}, thickness, 0}); }

std::unique_ptr<Scene> scene_of(std::shared_ptr<const CapWater> water, const Vec& rim = {0, 0, 0}, const Vec& around = {0, 0, 0}, const std::string& config = "") {
  auto scene = std::make_unique<Scene>(TracerOptions{config});
  add_cap_pane(*scene, std::move(water), emitter(rim), executor(), {});
  scene->set_environment(testing::constant(around));
  scene->commit();
  return scene;
}
/// Caps on one another and on a layer of heights.
std::shared_ptr<const CapWater> crowd(bool with_layer) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(0.004, 0.036), y(0.004, 0.026), size(0, 1);  // bases within the pane
  std::vector<CapBase> caps;
  for (int i = 0; i < 400; ++i) caps.push_back({x(random), y(random), 2e-4 / (0.05 + size(random))});
  CapWater::Layer layer{};
  if (with_layer) {
    Image height(Format::r32f, 60, 40);
    for (int j = 0; j < 40; ++j) {
      for (int i = 0; i < 60; ++i) height.row<float>(j)[i] = static_cast<float>(std::max(0.0, 0.6 * std::sin(0.4 * i + 0.1 * j) * std::sin(0.5 * j)));
    }
    layer = {std::make_shared<const WaterLayer>(height), {0.01, 0.005}, {0.024, 0.02}};
  }
  return std::make_shared<const CapWater>(pane(), caps, 50, layer);
}

// Sphere cap on plane-parallel glass, ray along the axis (W15), with nothing but roundings: the cap is no mesh.
TEST(CapWater, DeviatesByTheClosedForm) {
  const double radius = 8e-3, angle = 70, n = 1.333, rho = radius / std::sin(radians(angle));
  const auto scene = scene_of(std::make_shared<const CapWater>(pane(), std::vector<CapBase>{{0.02, 0.015, radius}}, angle));
  for (const double share : {0.0, 0.1, 0.3, 0.5, 0.7, 0.75}) {
    for (const double turn : {0.3, 2.1, 4.0}) {
      const Vec at(0.02 + share * rho * std::cos(turn), 0.015 + share * rho * std::sin(turn), -0.05);
      const StraightPath path = straight_path(*scene, {at, {0, 0, 1}});
      ASSERT_EQ(path.end, StraightPath::End::out) << share;
      ASSERT_EQ(path.interfaces, 3);
      const double toward = -(path.direction.x * std::cos(turn) + path.direction.y * std::sin(turn));
      // A rounding of the place, 1e-17 of 0.05 m, over rho; near the critical angle, .7502, the exit multiplies it by n / cos, 40.
      EXPECT_NEAR(std::asin(toward), std::asin(n * share) - std::asin(share), 1e-13) << share;
    }
  }
  EXPECT_NEAR((std::asin(n * 0.3) - std::asin(0.3)) / radians(1), 6.114, 1e-3);  // the table's value
  for (const double share : {0.7503, 0.8, 0.9}) {
    EXPECT_EQ(straight_path(*scene, {{0.02 + share * rho, 0.015, -0.05}, {0, 0, 1}}).end, StraightPath::End::mirrored) << share;
  }
}

// White in, white out, whichever of the caps and of the layer is met: every medium is where its neighbours say.
TEST(CapWater, StaysWhiteInAFurnace) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0.001, 0.039), y(0.001, 0.029), way(-0.7, 0.7);
  for (const bool with_layer : {false, true}) {
    const auto scene = scene_of(crowd(with_layer), {1, 1, 1}, {1, 1, 1});
    ShadingOptions options;
    options.depth = 24;
    int wet = 0;
    for (int i = 0; i < 4000; ++i) {
      const Ray ray{{x(random), y(random), i % 2 ? -0.02 : 0.02}, {way(random), way(random), i % 2 ? 1.0 : -1.0}};
      const Seen seen = testing::see(*scene, ray, options);
      ASSERT_NEAR(seen.radiance.x, 1, 1e-12) << i;
      wet += seen.film > 0;
    }
    EXPECT_GT(wet, 1000);
  }
}

// From inside the water every way leads to a surface that is left toward air or glass, never into water again.
TEST(CapWater, IsClosed) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> in(0, 1), way(-1, 1);
  for (const bool with_layer : {false, true}) {
    const auto water = crowd(with_layer);
    const auto scene = scene_of(water);
    int tried = 0, onto_caps = 0, onto_layer = 0;
    while (tried < 20000) {
      const double x = 0.04 * in(random), y = 0.03 * in(random);
      const Ray down{{x, y, 0.02}, {0, 0, -1}};
      Hit top;
      scene->tracer().first_hits({&down, 1}, {&top, 1});
      const double height = 0.02 - top.t;
      if (water->owner(x, y) == CapWater::dry || height < 2e-6) continue;
      ++tried;
      const Ray ray{{x, y, (0.01 + 0.98 * in(random)) * height}, {way(random), way(random), way(random)}};
      Hit hit;
      scene->tracer().first_hits({&ray, 1}, {&hit, 1});
      ASSERT_TRUE(hit.is_surface()) << tried;
      if (hit.surface == 2 || hit.surface == (with_layer ? 5u : 4u)) continue;  // the wet face, the rim
      ASSERT_NE(hit.surface, 1u) << tried;  // the dry face
      EXPECT_GT(dot(ray.direction, scene->tracer().surface(hit.surface).normal(ray, hit)), 0) << tried;
      onto_caps += hit.surface == 3;
      onto_layer += hit.surface == 4;
    }
    EXPECT_GT(onto_caps, 1000);
    EXPECT_EQ(onto_layer > 200, with_layer);
  }
}

TEST(CapWater, HitsHaveTheSameBitsForEveryEmbreeAndEqualTheOracles) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-0.005, 0.045), y(-0.005, 0.035), z(-0.01, 0.004);
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    const Vec from(x(random), y(random), z(random)), to(x(random), y(random), z(random));
    rays.push_back({from, to - from});
  }
  const auto water = crowd(true);
  std::vector<Hit> expected;
  for (const char* config : {"", "isa=sse2", "isa=sse4.2", "isa=avx", "isa=avx2", "isa=avx512"}) {
    const auto scene = scene_of(water, {0, 0, 0}, {0, 0, 0}, config);
    std::vector<Hit> hits(rays.size());
    scene->tracer().first_hits(rays, hits);
    if (expected.empty()) {
      expected = hits;
      std::vector<std::shared_ptr<const Surface>> all;
      for (std::uint32_t s = 0; s < scene->surfaces(); ++s) all.emplace_back(std::shared_ptr<void>(), &scene->tracer().surface(s));
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit oracle = first_hit_of_all(all, rays[i]);
        ASSERT_TRUE(oracle.t == hits[i].t && oracle.surface == hits[i].surface && oracle.part == hits[i].part) << i;
      }
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit &a = hits[i], &b = expected[i];
      ASSERT_TRUE(a.t == b.t && a.surface == b.surface && a.part == b.part && a.u == b.u && a.v == b.v) << config << " ray " << i;
    }
  }
}

TEST(CapWater, RefusesBentAndShearedPanes) {
  EXPECT_THROW(CapWater(Pane({{0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0}, {0, 0, 1}, 5e-3, 1}), {}, 50), Error);
  EXPECT_THROW(CapWater(Pane({{0, 0, 0}, {0.4, 0, 0}, {0.1, 0.3, 0}, {0, 0, 1}, 5e-3, 0}), {}, 50), Error);
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
    in.colour = Image(Format::rgba32f, s.width, s.height);
    for (int y = 0; y < s.height; ++y) {
      for (int i = 0; i < 4 * s.width; ++i) in.colour.row<float>(y)[i] = static_cast<float>(0.05 + 0.01 * ((i * 7 + y * 13) % 97));
    }
  }
  PaneTruth truth(double thickness) {
    fill();
    screen_drops::ScreenDrops drops(s, in, executor());
    drops.render();
    return compare(drops, ScreenDropsView(s, in.colour, thickness, {}, executor()), {}, executor());
  }
};
std::size_t pixels(const PaneTruth& truth, const std::string& name) {
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
  drops.render();
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
  const PaneTruth truth = w.truth(1e-5);
  EXPECT_GT(pixels(truth, "drop_pixels"), 1000u);
  EXPECT_LT(100 * (pixels(truth, "drop_not_wet") + pixels(truth, "wet_not_drop")), pixels(truth, "drop_pixels"));  // centres that the rim meets
  EXPECT_EQ(pixels(truth, "mirrored_pixels"), 0u);
  const Percentiles p = truth.differences[0].percentiles();
  // A lens of 2 degrees turns rays by up to (n - 1) 2 = 0.67. Where they run on in it for its height, at 20 degrees, they miss
  // (n - 1) a^2 / 2 tan 20 / n = 0.003 degrees. Where two drops overlap the pass shows the coarser one and the rays the higher: twice 0.67, and
  // up to a tenth more at a slant.
  EXPECT_LT(p.p50, 0.003);
  EXPECT_LT(p.max, 1.48);
}

TEST(TracedWindow, RefusesWhatItCannotTrace) {
  Window w;
  w.fill();
  EXPECT_THROW(ScreenDropsView(w.s, w.in.colour, 0.1, {}, executor()), Error);  // the eye is 0.09 m away
  w.s.variant = screen_drops::Variant::as_published;
  EXPECT_THROW(ScreenDropsView(w.s, w.in.colour, 1e-3, {}, executor()), Error);
}

// ---- rainy_glass ----------------------------------------------------------------------------------------------------
struct Conservatory {
  rainy_glass::Settings s;
  rainy_glass::Surroundings around, unbarred;
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
    around = rainy_glass::make_backdrop(s, {0.01, bars, 0.03}, executor());
    unbarred = rainy_glass::make_backdrop(s, {0.01, 0, 0.03}, executor());
    glass.emplace(s, around, executor());
    for (int frame = 0; frame < 20; ++frame) glass->frame();
  }
  RainyGlassView view(double thickness) const { return {s, around, unbarred, thickness, {}}; }
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
    // A fraction of texels lies between a place and the same by way of the pane's corners: steep slopes change by some 1e-12.
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
  const PaneTruth truth = compare(*c.glass, c.view(1e-5), {}, executor());
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
      if (c.around.depth.row<float>(y)[x] > c.glass->surface().row<float>(y)[4 * x + 2]) continue;
      ++bars;
      for (int k = 0; k < 3; ++k) ASSERT_EQ(to_float(traced.beauty.row<Half>(y)[4 * x + k]), to_float(c.glass->colour().row<Half>(y)[4 * x + k]));
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
}  // namespace rainref::compositor
