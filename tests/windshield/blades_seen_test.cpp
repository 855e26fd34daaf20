// Blades in the scene's picture: where they are drawn, and that nothing else changes.
#include "windshield/scene/blades_seen.h"

#include <cmath>

#include <gtest/gtest.h>

#include "image/flipped.h"
#include "image/images.h"
#include "math/half.h"
#include "rainref/windshield.h"
#include "simulation/small_scenes.h"

namespace rainref::windshield {
namespace {

constexpr int width = 320, height = 180;
const std::array<double, 2> half_size{0.8, 0.45};

SceneView bright(int columns = width, int rows = height) {
  SceneView view{Image(Format::rgba16f, columns, rows), Image(Format::r32f, columns, rows)};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      for (int c = 0; c < 4; ++c) view.colour.row<Half>(y)[4 * x + c] = to_half(1.0f);
      view.depth.row<float>(y)[x] = 100;
    }
  return view;
}
double red(const SceneView& view, int x, int y) { return to_float(view.colour.row<Half>(y)[4 * x]); }
/// A glass 1.4 m wide that stands upright 1 m before an eye at (0, 0, 1.2).
Glass upright() { return make_glass({{{1, 0.7, 0.8}, {1, -0.7, 0.8}, {1, 0.7, 1.6}}}); }
scene::Camera eye() { return {{0, 0, 1.2}, {10, 0, 1.2}, {0, 0, 1}, 30}; }
Wiper blade_at(double x, double y, double angle) {
  Wiper w{};
  w.pivot[0] = static_cast<float>(x);
  w.pivot[1] = static_cast<float>(y);
  w.inner_radius = 0.2f;
  w.outer_radius = 0.6f;
  w.axis[0] = static_cast<float>(std::cos(angle));
  w.axis[1] = static_cast<float>(std::sin(angle));
  w.half_width = 0.008f;
  return w;
}

// The pivot in the middle of the lower edge, plane (0.7, 0), is 0.4 m below the eye; its blade stands upright, 12 mm beyond the glass: at
// depth 1.012 from y = -0.2 to 0.2 and half of it, and of the way to the pivot, behind an arm.
TEST(BladesSeen, ABladeHidesWhatLiesBehindIt) {
  std::vector<SeenBlade> seen;
  const std::vector<Wiper> wipers{blade_at(0.7, 0, 1.0), blade_at(0.7, 0, std::acos(0.0))};
  add_seen(seen, wipers, upright(), eye());
  ASSERT_EQ(seen.size(), 1U) << "the last record of a pivot says where its blade is";
  SceneView view = bright();
  draw_blades(seen, half_size, view, parallel::Executor(2));
  const auto column = [](double x) { return static_cast<int>((x / half_size[0] + 1) / 2 * width); };
  const auto row = [](double y) { return static_cast<int>((y / half_size[1] + 1) / 2 * height); };
  EXPECT_LT(red(view, column(0), row(0.1 / 1.012)), 0.01);
  EXPECT_NEAR(static_cast<double>(view.depth.row<float>(row(0.1 / 1.012))[column(0)]), 1.012, 1e-6);
  EXPECT_LT(red(view, column(0), row(-0.3 / 1.025)), 0.01) << "the arm";
  EXPECT_NEAR(static_cast<double>(view.depth.row<float>(row(-0.3 / 1.025))[column(0)]), 1.025, 1e-6);
  EXPECT_EQ(red(view, column(0), row(0.22)), 1) << "beyond its end";
  EXPECT_EQ(red(view, column(0), row(-0.43)), 1) << "below the pivot";
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(red(view, column(side * 0.02), row(0.1)), 1) << "beside it";
    EXPECT_EQ(view.depth.row<float>(row(0.1))[column(side * 0.02)], 100);
  }
  // Its width of 16 mm at this depth, whatever the softness of its edges.
  double hidden = 0;
  for (int x = 0; x < width; ++x) hidden += (1 - red(view, x, row(0.1))) * 2 * half_size[0] / width * 1.012;
  EXPECT_NEAR(hidden, 0.016, 0.0005) << "shares are those of texels' centres";
}
TEST(BladesSeen, BehindTheEyeThereIsNone) {
  std::vector<SeenBlade> seen;
  scene::Camera back = eye();
  back.target = {-10, 0, 1.2};
  add_seen(seen, std::vector<Wiper>{blade_at(0.7, 0, 1.57)}, upright(), back);
  SceneView view = bright();
  draw_blades(seen, half_size, view, parallel::Executor(2));
  EXPECT_TRUE(same(view.colour, bright().colour));
}
TEST(BladesSeen, SameBitsForAnyThreads) {
  std::vector<SeenBlade> seen;
  add_seen(seen, std::vector<Wiper>{blade_at(0.7, 0, 1.2), blade_at(0.3, 0, 0.6)}, upright(), eye());
  SceneView expected = bright();
  draw_blades(seen, half_size, expected, parallel::Executor(1));
  for (const int threads : {2, 3, 8}) {
    parallel::Executor several(threads);
    several.shuffle_tiles(5);
    SceneView view = bright();
    draw_blades(seen, half_size, view, several);
    EXPECT_TRUE(same(view.colour, expected.colour) && same(view.depth, expected.depth)) << threads;
  }
}

// A scene that stands still is drawn anew behind blades that moved on; water and drops do not hear of it.
TEST(BladesSeen, OnlyTheScenesPictureChanges) {
  const auto opened = [](const char* more, const parallel::Executor& executor) {
    SceneView picture = bright(64, 36);
    Surroundings around;
    around.colour = std::move(picture.colour);
    around.depth = std::move(picture.depth);
    return Windshield(small("windshield", "corrected", {"run.fps=10", "wipers.cycles_per_minute=60", more}), std::move(around), executor);
  };
  const parallel::Executor executor(2);
  Windshield with = opened("scene.blades=true", executor), without = opened("scene.blades=false", executor);
  Image before;
  for (int frame = 0; frame < 3; ++frame) {
    for (Windshield* w : {&with, &without}) {
      w->simulate(nullptr);
      w->render(nullptr);
    }
    EXPECT_TRUE(same(without.scene_colour(), bright(64, 36).colour));
    int darker = 0;
    for (int y = 0; y < 36; ++y)
      for (int x = 0; x < 64; ++x) darker += to_float(with.scene_colour().row<Half>(y)[4 * x]) < 0.5f;
    EXPECT_GT(darker, 10);
    EXPECT_LT(darker, 64 * 36 / 4);
    EXPECT_TRUE(same(with.height(), without.height()) && same(with.normal(), without.normal()) && same(with.mask(), without.mask()));
    EXPECT_FALSE(same(with.colour(), without.colour()));
    if (frame > 0) {
      EXPECT_FALSE(same(with.scene_colour(), before)) << "blades move";
    }
    before = copy_of(with.scene_colour());
  }
}

}  // namespace
}  // namespace rainref::windshield
