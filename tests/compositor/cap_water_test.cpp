// Caps of water on a pane, alone and in crowds, against the laws of optics in closed form.
#include "compositor/embree_isas.h"
#include "compositor/cap_water.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compositor/shading_support.h"
#include "compositor/straight_path.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

using testing::radians;

const parallel::Executor& executor() {
  static const parallel::Executor two(2);
  return two;
}
/// 40 mm x 30 mm in the plane z = 0, outward +z.
Pane pane(double thickness = 5e-3) { return Pane({{0, 0, 0}, {0.04, 0, 0}, {0, 0.03, 0}, {0, 0, 1}, thickness, 0}); }

std::unique_ptr<Scene> scene_of(std::shared_ptr<const CapWater> water, const Vec& rim = {0, 0, 0}, const Vec& around = {0, 0, 0},
                                const std::string& config = "") {
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
      for (int i = 0; i < 60; ++i)
        height.row<float>(j)[i] = static_cast<float>(std::max(0.0, 0.6 * std::sin(0.4 * i + 0.1 * j) * std::sin(0.5 * j)));
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
      ASSERT_NE(hit.surface, 1u) << tried;                                      // the dry face
      EXPECT_GT(dot(ray.direction, scene->tracer().surface(hit.surface).normal(ray, hit)), 0) << tried;
      onto_caps += hit.surface == 3;
      onto_layer += hit.surface == 4;
    }
    EXPECT_GT(onto_caps, 1000);
    EXPECT_EQ(onto_layer > 200, with_layer);
  }
}

TEST(CapWater, HitsHaveTheSameBitsForEveryEmbree) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-0.005, 0.045), y(-0.005, 0.035), z(-0.01, 0.004);
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    const Vec from(x(random), y(random), z(random)), to(x(random), y(random), z(random));
    rays.push_back({from, to - from});
  }
  const auto water = crowd(true);
  test::hits_for_every_embree(rays, [&](const std::string& config) { return scene_of(water, {0, 0, 0}, {0, 0, 0}, config); });
}

TEST(CapWater, RefusesBentAndShearedPanes) {
  EXPECT_THROW(CapWater(Pane({{0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0}, {0, 0, 1}, 5e-3, 1}), {}, 50), Error);
  EXPECT_THROW(CapWater(Pane({{0, 0, 0}, {0.4, 0, 0}, {0.1, 0.3, 0}, {0, 0, 1}, 5e-3, 0}), {}, 50), Error);
}

}  // namespace
}  // namespace rainref::compositor
