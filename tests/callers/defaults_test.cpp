// Every effect runs with what its public header says by default, and that is what a scene gives that says nothing.
#include <gtest/gtest.h>

#include "config_of.h"
#include "edge_splash/parameters.h"
#include "image/images.h"
#include "puddle/parameters.h"
#include "rainref/edge_splash.h"
#include "rainref/error.h"
#include "rainref/puddle.h"
#include "rainref/rainy_glass.h"
#include "rainref/screen_drops.h"
#include "rainref/windshield.h"
#include "rainy_glass/parameters.h"
#include "scene/test_card.h"
#include "screen_drops/parameters.h"

namespace rainref {
namespace {

/// An image of one value.
Image filled(Format format, int width, int height, float value) {
  return make_image(format, width, height, [=](int, int, int) { return value; });
}
/// Somewhere in the picture something is lit: code 0 all over would be a camera that sees nothing.
void expect_lit(const Image& picture) {
  ASSERT_EQ(picture.format(), Format::rgba8);
  int brightest = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) brightest = std::max<int>(brightest, picture.row<Unorm8>(y)[4 * x].code);
  }
  EXPECT_GT(brightest, 0);
}

class Defaults : public testing::Test {
 protected:
  parallel::Executor executor{2};
};

TEST_F(Defaults, Puddle) {
  const puddle::Settings settings;
  puddle::Surroundings around;
  around.environment = filled(Format::rgba32f, 4, 2, 0.5f);
  puddle::Puddle puddle(settings, around, executor);
  puddle.next_frame();
  expect_lit(puddle.picture());
  around.environment = Image();
  EXPECT_THROW(puddle::Puddle(settings, around, executor), Error);
}
TEST_F(Defaults, EdgeSplash) {
  const edge_splash::Settings settings;
  edge_splash::Inputs in;
  in.colour = filled(Format::rgba32f, settings.width, settings.height, 0.5f);
  in.depth = filled(Format::r32f, settings.width, settings.height, 2);
  in.depth_is_distance = true;
  edge_splash::EdgeSplash effect(settings, in, executor);
  effect.next_frame();
  expect_lit(effect.picture());
}
TEST_F(Defaults, RainyGlass) {
  const rainy_glass::Settings settings;
  rainy_glass::Surroundings around;
  around.colour = filled(Format::rgba32f, settings.width, settings.height, 0.5f);
  around.depth = filled(Format::r32f, settings.width, settings.height, 9);
  rainy_glass::RainyGlass glass(settings, around, executor);
  glass.next_frame();
  expect_lit(glass.picture());
}
TEST_F(Defaults, ScreenDrops) {
  const screen_drops::Settings settings;
  screen_drops::Inputs in;
  in.colour = filled(Format::rgba32f, settings.width, settings.height, 0.5f);
  screen_drops::ScreenDrops still(settings, in, executor);
  still.next_frame();
  expect_lit(still.picture());
  // The whole scene, its flowing water with it.
  screen_drops::ScreenDrops flowing(SceneText{}, in, executor);
  flowing.next_frame();
  expect_lit(flowing.picture());
  EXPECT_GT(flowing.height().width(), 1);
}
TEST_F(Defaults, Windshield) {
  windshield::Windshield windshield(SceneText{"", {"run.size=[160, 90]", "scene.size=[160, 90]"}}, {{}, {}, scene::TestCard::make()},
                                    executor);
  windshield.next_frame();
  expect_lit(windshield.picture());
  EXPECT_EQ(windshield.mass_balance().residual(), 0);
}

/// The settings of a scene that names effect and variant and nothing else.
template <class Read>
auto silent_scene(const char* effect, Variant variant, std::span<const scene::Parameter> parameters, Read read) {
  return read(test::config_of(effect, parameters, name(variant), ""));
}
TEST_F(Defaults, AreThoseOfAScene) {
  for (const Variant v : {Variant::as_published, Variant::corrected}) {
    EXPECT_EQ(silent_scene("puddle", v, puddle::parameters(), puddle::settings_from), puddle::default_settings(v));
    EXPECT_EQ(silent_scene("edge_splash", v, edge_splash::parameters(), edge_splash::settings_from), edge_splash::default_settings(v));
    EXPECT_EQ(silent_scene("rainy_glass", v, rainy_glass::parameters(), rainy_glass::settings_from), rainy_glass::default_settings(v));
    EXPECT_EQ(silent_scene("screen_drops", v, screen_drops::parameters(), screen_drops::settings_from), screen_drops::default_settings(v));
  }
  EXPECT_EQ(puddle::Settings{}, puddle::default_settings(Variant::corrected));
  EXPECT_EQ(edge_splash::Settings{}, edge_splash::default_settings(Variant::corrected));
  EXPECT_EQ(rainy_glass::Settings{}, rainy_glass::default_settings(Variant::corrected));
  EXPECT_EQ(screen_drops::Settings{}, screen_drops::default_settings(Variant::corrected));
  // Once more as numbers: table and struct alone would agree on anything.
  const puddle::Settings puddle, published = puddle::default_settings(Variant::as_published);
  EXPECT_EQ(puddle.rain_rate, 5);
  EXPECT_EQ(puddle.smallest_drop, 1.6);
  EXPECT_EQ(puddle.damping, 0.96);
  EXPECT_EQ(puddle.ground_scale, 1.6);
  EXPECT_EQ(puddle.puddle_depth, 0.03);
  EXPECT_EQ(published.damping, 0.98);
  EXPECT_EQ(published.ground_scale, 0.15);
  EXPECT_EQ(published.puddle_depth, 5);
  EXPECT_EQ(published.camera_position, (std::array<double, 3>{20, 18, 14}));
  EXPECT_TRUE(published.use_checkerboard);
  EXPECT_EQ(rainy_glass::Settings{}.droplet_count, 2200);
  EXPECT_EQ(rainy_glass::Settings{}.map_storage, Format::rgba16f);
  EXPECT_EQ(rainy_glass::default_settings(Variant::as_published).map_storage, Format::rgba8);
  EXPECT_EQ(edge_splash::Settings{}.drop_alpha, 0.85);
  EXPECT_EQ(edge_splash::default_settings(Variant::as_published).drop_alpha, 1);
  EXPECT_EQ(edge_splash::Settings{}.depth.far_plane, 1000);
  EXPECT_EQ(screen_drops::Settings{}.exposure, 0.5);
}

}  // namespace
}  // namespace rainref
