// The windshield as a whole: its water, and the pictures before it.
#include <gtest/gtest.h>

#include <algorithm>

#include "image/images.h"
#include "rainref/error.h"
#include "scene/test_card.h"
#include "windshield/golden_scenes.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

// Every mass unit that arrived is in a drop, in the film, in the air, or gone: exactly (W8), through wipers and merging.
TEST(MassBalance, IsZeroToTheUnit) {
  const parallel::Executor executor(2);
  for (const int substeps : {1, 3}) {
    const std::string more = fmt::format("substeps = {}\nmobility = 0.05\ntrail_thickness = 2e-5\n[rain]\nrate = 150\n", substeps);
    Windshield windshield(config_of("corrected", wet_drive + more), small_surroundings(), executor);
    for (int frame = 0; frame < 240; ++frame) {
      windshield.simulate();
      ASSERT_EQ(windshield.mass_balance().residual(), 0) << "frame " << frame << ", " << substeps << " substeps";
    }
    // Nothing of it is idle.
    const MassBalance balance = windshield.mass_balance();
    EXPECT_GT(balance.spawned, 1'000'000);
    EXPECT_GT(balance.evaporated, 0);
    EXPECT_GT(balance.removed, 0);
    EXPECT_GT(balance.film, 0);
    EXPECT_GT(balance.drops, 0);
  }
}

// As published counts drops.
TEST(MassBalance, AsPublishedCountsDrops) {
  const parallel::Executor executor(1);
  Windshield windshield(config_of("as-published", fmt::format("{}lifetime = 0.5\n", wet_drive)), small_surroundings(), executor);
  for (int frame = 0; frame < 90; ++frame) {
    windshield.simulate();
    ASSERT_EQ(windshield.mass_balance().residual(), 0) << frame;
  }
  EXPECT_GT(windshield.mass_balance().removed, 100);
  EXPECT_EQ(windshield.mass_balance().spawned, 600);  // 400 a second
}

// A dry glass shows the scene through a film at most: corrected, without rain and haze, the picture is the scene's own.
TEST(Picture, ADryGlassShowsTheScene) {
  const parallel::Executor executor(1);
  const std::string toml = R"([run]
size = [37, 23]
[windshield]
height_size = [16, 16]
[rain]
rate = 0
[blur]
fog_density = 0
[composite]
wetness = 0
[scene]
margin = 1
[camera]
vertical_fov_deg = 10
)";
  Windshield windshield(config_of("corrected", toml), small_surroundings(), executor);
  windshield.simulate();
  windshield.render();
  const Surroundings expected = small_surroundings();
  const TextureData a(windshield.colour(), Address::clamp, Address::clamp), b(expected.colour, Address::clamp, Address::clamp);
  // Level water mirrors 2 % of the blurred scene at normal incidence, more at this slant; the rest comes straight through.
  int different = 0;
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      const float seen = a.view().texels[4 * (y * 37 + x)], there = b.view().texels[4 * (y * 37 + x)];
      different += !(seen > 0.6f * there && seen < 1.3f * there);
    }
  }
  EXPECT_EQ(different, 0);
}

/// small_surroundings mirrored.
Surroundings other_surroundings() {
  const Surroundings from = small_surroundings();
  Surroundings to = small_surroundings();
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      std::copy_n(from.colour.row<Half>(y) + 4 * (36 - x), 4, to.colour.row<Half>(y) + 4 * x);
      to.depth.row<float>(y)[x] = from.depth.row<float>(y)[36 - x];
    }
  }
  return to;
}
// From the next render on it is as if it had been made with these pictures, and nothing else changes.
TEST(Show, OtherPicturesAreSeenFromTheNextRenderOn) {
  const parallel::Executor executor(1);
  for (const char* variant : {"as-published", "corrected"}) {
    const scene::Config config = config_of(variant, wet_drive);
    Windshield shown(config, small_surroundings(), executor), first(config, small_surroundings(), executor),
        second(config, other_surroundings(), executor);
    for (Windshield* w : {&shown, &first, &second}) w->next_frame();
    EXPECT_TRUE(same(shown.picture(), first.picture()));
    EXPECT_FALSE(same(first.picture(), second.picture()));
    shown.show(other_surroundings());
    for (Windshield* w : {&shown, &first, &second}) w->next_frame();
    EXPECT_TRUE(same(shown.colour(), second.colour()));
    EXPECT_TRUE(same(shown.scene_colour(), second.scene_colour()) && same(shown.scene_depth(), second.scene_depth()));
    EXPECT_FALSE(same(shown.colour(), first.colour()));
    EXPECT_TRUE(same(shown.height(), first.height()));
  }
}
TEST(Show, RefusesWhatItCannotShow) {
  using testing::HasSubstr;
  const parallel::Executor executor(1);
  Windshield windshield(config_of("corrected", ""), small_surroundings(), executor);
  EXPECT_THAT(usage_error([&] {
                windshield.show({Image(Format::rgba16f, 37, 24), Image(Format::r32f, 37, 24)});
              }),
              HasSubstr("scene.image: expected 37x23 texels as before, found 37x24"));
  EXPECT_THAT(usage_error([&] {
                windshield.show({Image(Format::rgba32f, 37, 23), Image(Format::r32f, 37, 23)});
              }),
              HasSubstr("scene.image: expected rgba16f of 37x23, found rgba32f"));
  EXPECT_THAT(usage_error([&] {
                windshield.show({Image(Format::rgba16f, 37, 23), Image(Format::r32f, 36, 23)});
              }),
              HasSubstr("scene.depth_image: expected r32f of 37x23, found r32f of 36x23"));
  EXPECT_THAT(usage_error([&] { windshield.show({}); }), HasSubstr("found 0x0"));
  Windshield street(SceneText{"", {"scene.size=[16, 9]"}}, {{}, {}, scene::TestCard::make()}, executor);
  EXPECT_THAT(usage_error([&] { street.show(small_surroundings()); }),
              HasSubstr("scene.image: expected pictures from the start, found a street"));
  EXPECT_THAT(usage_error([&] {
                Windshield(SceneText{"", {"windshield.height_size=[32, 18]"}}, {}, executor);
              }),
              HasSubstr("scene.image: expected pictures of what lies before the car or a street, found neither"));
  EXPECT_THAT(usage_error([&] {
                Windshield(SceneText{"", {"scene.depth=5"}}, small_surroundings(), executor);
              }),
              HasSubstr("scene.depth: expected none beside pictures in memory"));
  // Who hands in pictures shows others himself.
  EXPECT_THAT(usage_error([&] {
                Windshield(SceneText{"", {"sequence.end=loop"}}, small_surroundings(), executor);
              }),
              HasSubstr("--set sequence.end: expected none where no picture's name holds a number"));
}

std::string refusal(const std::string& variant, const std::string& toml) {
  const parallel::Executor executor(1);
  return usage_error([&] { Windshield(config_of(variant, toml), small_surroundings(), executor); });
}
TEST(BadScene, IsRefusedByKey) {
  EXPECT_NE(refusal("corrected", "[windshield]\ncorner_2 = [1.9, 0.0, 1.0]\n").find("windshield.corner_"), std::string::npos);
  EXPECT_NE(refusal("corrected", "[rain]\nrate = -1\n").find("rain.rate"), std::string::npos);
  EXPECT_NE(refusal("as-published", "[windshield]\nspawn_rate = -1\n").find("windshield.spawn_rate"), std::string::npos);
  EXPECT_NE(refusal("corrected", "[wipers]\narrangement = 'custom'\nouter_radius_0 = 5.0\n").find("wipers.outer_radius_0"),
            std::string::npos);
  EXPECT_NE(refusal("corrected", "[wipers]\narrangement = 'custom'\nsweep_0 = 0.0\n").find("wipers.sweep_0"), std::string::npos);
  EXPECT_NE(refusal("corrected", "[camera]\nposition = [1.9, 0.0, 1.0]\n").find("camera.position"), std::string::npos);
}

}  // namespace
}  // namespace rainref::windshield
