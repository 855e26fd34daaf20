// The scene keys of glass, vehicle and wipers, as a scene file gives them.
#include <gtest/gtest.h>

#include "scene/toml.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

using testing::HasSubstr;

scene::EffectTable effects() {
  static const std::vector<scene::Parameter> parameters = motion_parameters();
  return {{{"windshield", {"as-published", "corrected"}, parameters}}};
}
MotionSettings settings_of(const std::string& keys, const char* variant = "corrected") {
  const std::string text = std::string("effect = \"windshield\"\nvariant = \"") + variant + "\"\n" + keys;
  return motion_settings_from(scene::parse(text, "scenes/x.toml", {}, effects()));
}

TEST(MotionParameters, DefaultsMakeBothVariants) {
  const MotionSettings c = settings_of(""), p = settings_of("", "as-published");
  EXPECT_EQ(c.wipers.blades.size(), 2u);
  EXPECT_EQ(c.wipers.half_width, 0.008);
  EXPECT_EQ(p.wipers.half_width, 0.025);
  EXPECT_EQ(p.capture.follow, 0.6);
  EXPECT_EQ(c.gravity, 9.80665);
  // The published texture is wiped by the blades' outlines alone: at 60 frames these leave no gap, 2 w >= r dtheta, at
  // the fastest step.
  for (const Blade& b : p.wipers.blades)
    EXPECT_GE(2 * p.wipers.half_width, b.outer_radius * pi * p.wipers.cycles_per_minute / 60 * b.sweep / 60);
}

// The keys of the custom arrangement begin as the tandem one.
TEST(MotionParameters, CustomBeginsAsTandem) {
  const MotionSettings custom = settings_of("wipers.arrangement = \"custom\"\n"), tandem = settings_of("");
  for (int i = 0; i < 2; ++i) {
    const Blade &a = custom.wipers.blades[i], &b = tandem.wipers.blades[i];
    EXPECT_NEAR(a.pivot[0], b.pivot[0], 1e-12);
    EXPECT_NEAR(a.pivot[1], b.pivot[1], 1e-12);
    EXPECT_NEAR(a.inner_radius, b.inner_radius, 1e-12);
    EXPECT_NEAR(a.outer_radius, b.outer_radius, 1e-12);
    EXPECT_NEAR(a.start_angle, b.start_angle, 1e-12);
    EXPECT_NEAR(a.sweep, b.sweep, 1e-12);
  }
  const MotionSettings other = settings_of(
      "wipers.count = 1\nwipers.arrangement = \"custom\"\nwipers.pivot_0 = [0.7, 0.1]\nwipers.phase_0 = "
      "0.5\nwipers.sweep_0 = -30.0\n");
  ASSERT_EQ(other.wipers.blades.size(), 1u);
  EXPECT_EQ(other.wipers.blades[0].pivot, (Real2{0.7, 0.1}));
  EXPECT_NEAR(wiper_angle(other.wipers.blades[0], 45, 0), -26 * degree, 1e-12);
}

TEST(MotionParameters, TablesOfSpeedAreFoundFromTheScenesFolder) {
  EXPECT_EQ(settings_of("vehicle.drive_cycle = \"cycles/us06.csv\"\n").vehicle.drive_cycle, "scenes/cycles/us06.csv");
  EXPECT_EQ(settings_of("vehicle.key_frames = \"0 0; 1 5\"\nvehicle.start = 0.5\n").vehicle.start, 0.5);
}

TEST(MotionParameters, WhatCannotBeIsNamed) {
  const auto message = [](const std::string& keys) { return usage_error([&] { settings_of(keys); }); };
  EXPECT_EQ(message("vehicle.key_frames = \"0 0; 1 5\"\nvehicle.speed = 3.0\n"),
            "scenes/x.toml:4:9: vehicle.speed: expected none beside vehicle.key_frames or vehicle.drive_cycle, found 3");
  EXPECT_THAT(message("windshield.corner_1 = [1.9, 0.7, 1.0]\n"), HasSubstr("windshield.corner_1"));
  EXPECT_THAT(message("wipers.arrangement = \"custom\"\nwipers.sweep_1 = 0.0\n"), HasSubstr("wipers.sweep_1: expected a turn"));
  EXPECT_THAT(message("wipers.arrangement = \"parallel\"\n"), HasSubstr("tandem"));
  EXPECT_THAT(message("wipers.follow = 0.5\n"), HasSubstr("wipers.follow"));  // published only
  EXPECT_THAT(message("wipers.half_width = 0.1\n"), HasSubstr("wipers.inner_radius_0"));
}

}  // namespace
}  // namespace rainref::windshield
