// Bad settings and images: one clear error each, naming key, expected and found.
#include <gmock/gmock.h>

#include "screen_drops/golden_scenes.h"
#include "screen_drops/info.h"
#include "screen_drops/parameters.h"
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::settings;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string error_with(const Settings& s) {
  return error_of([&] { ScreenDrops(s, test::inputs(settings(s.variant, 12, 9)), test::executor()); });
}

TEST(ScreenDropsErrors, ZeroScalesAndPanes) {
  const Settings good = settings(Variant::corrected, 12, 9);
  EXPECT_EQ(error_with(good), "none");
  Settings s = good;
  s.pane_height = 0;
  EXPECT_THAT(error_with(s), AllOf(StartsWith("2 "), HasSubstr("glass.height: expected more than 0, found 0")));
  s = good;
  s.largest_radius = 0;
  EXPECT_THAT(error_with(s), HasSubstr("drops.largest_radius: expected more than 0, found 0"));
  s = good;
  s.scene_margin = 0;
  EXPECT_THAT(error_with(s), HasSubstr("scene.margin: expected more than 0"));
  s = good;
  s.shortest_cycle = 4;
  EXPECT_THAT(error_with(s), HasSubstr("drops.shortest_cycle: expected at most drops.longest_cycle = 3 s, found 4"));
  s = good;
  s.longest_cycle = 70;
  EXPECT_THAT(error_with(s), HasSubstr("drops.longest_cycle: expected at most 65.535 s, found 70"));
  s = good;
  s.largest_radius = 1e-4;
  EXPECT_THAT(error_with(s),
              HasSubstr("drops.largest_radius: expected drops that 16 million cells hold, found 0.0001 mm for a pane 0.02 m high"));
  s = good;
  s.contact_angle_deg = 90;
  EXPECT_THAT(error_with(s), HasSubstr("drops.contact_angle"));
  s = settings(Variant::as_published, 12, 9);
  s.grid = 0;
  EXPECT_THAT(error_with(s), HasSubstr("drops.grid: expected more than 0, found 0"));
  s = good;
  s.camera_target = s.camera_position;
  EXPECT_THAT(error_with(s), StartsWith("2 "));
}
TEST(ScreenDropsErrors, ImagesOfAnotherShape) {
  const Settings s = settings(Variant::as_published, 12, 9);
  const auto error_for = [&](const Inputs& in) { return error_of([&] { ScreenDrops(s, in, test::executor()); }); };
  EXPECT_THAT(error_for({}), HasSubstr("scene.image: expected an image of four channels"));
  EXPECT_THAT(error_for(test::inputs(settings(Variant::as_published, 12, 8))),
              HasSubstr("scene.image: expected 12x9 like the picture, found 12x8"));
  Inputs in = test::inputs(s);
  in.noise = Image(Format::rg32f, 8, 8);
  EXPECT_THAT(error_for(in), HasSubstr("noise.image: expected four channels, found 2"));
}
TEST(ScreenDropsErrors, ScenesRefuseWhatTheVariantHasNot) {
  const auto load = [&](const std::string& variant, const std::string& more) { return error_of([&] { config_of(variant, more); }); };
  EXPECT_EQ(load("corrected", ""), "none");
  EXPECT_EQ(load("as-published", ""), "none");
  EXPECT_THAT(load("as-published", "[glass]\nheight = 3\n"), HasSubstr("glass.height"));
  EXPECT_THAT(load("as-published", "[flow]\non = false\n"), HasSubstr("flow.on"));
  EXPECT_THAT(load("corrected", "[glass]\nheight = 0\n"), HasSubstr("glass.height"));
  EXPECT_THAT(load("corrected", "[glass]\nheigth = 1\n"), HasSubstr("glass.height"));  // the nearest name
  EXPECT_THAT(load("corrected", "[drops]\nrounding = \"rze\"\n"), HasSubstr("rtz"));
}
TEST(ScreenDropsErrors, SettingsOfAScene) {
  const scene::Config c = config_of("corrected", "[glass]\nheight = 0.3\n[run]\nsize = [200, 100]\n");
  const Settings s = settings_from(c);
  EXPECT_EQ(s.pane_height, 0.3);
  const auto flow = flow_from(c, s);
  ASSERT_TRUE(flow);
  EXPECT_DOUBLE_EQ(flow->pane[0], 0.6);
  EXPECT_DOUBLE_EQ(flow->pane[1], 0.3);
  const scene::Config still = config_of("corrected", "flow.on = false\n");
  EXPECT_FALSE(flow_from(still, settings_from(still)));
}

}  // namespace
}  // namespace rainref::screen_drops
