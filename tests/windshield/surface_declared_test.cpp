// The scene keys of wipe_texture and normals, and the host's values.
#include <gtest/gtest.h>

#include "config_of.h"
#include "rainref/error.h"
#include "windshield/info.h"
#include "windshield/parameters.h"

namespace rainref::windshield {
namespace {

Settings read(const std::string& variant, const std::vector<std::string>& values) {
  return settings_from(rainref::test::config_of("windshield", parameters(), variant, "", values));
}

TEST(SurfaceDeclared, ScenesSetWhatTheVariantUses) {
  const SurfaceSettings published = read("as-published", {"windshield.wipe_strength=2", "windshield.mask_tau=10"}).surface;
  EXPECT_FALSE(published.corrected);
  EXPECT_EQ(published.wipe_strength, 2);
  EXPECT_EQ(published.mask_tau, 10);
  EXPECT_TRUE(read("corrected", {}).surface.corrected);
  EXPECT_THROW(read("corrected", {"windshield.wipe_strength=2"}), Error);

  const blur_pyramid::BlurSettings blur =
      read("corrected", {"blur.blur_levels=3", "blur.fog_density=0.5", "blur.fog_colour=[1, 2, 3]", "windshield.rounding=rtz"}).blur;
  EXPECT_TRUE(blur.corrected);
  EXPECT_EQ(blur.levels, 3);
  EXPECT_EQ(blur.fog_density, 0.5);
  EXPECT_EQ(blur.fog_colour[2], 3);
  EXPECT_EQ(blur.rounding, Rounding::rtz);
}

// The declared range holds what the largest time constant lets `wiped` grow to.
TEST(SurfaceDeclared, TheTimeSinceAWipeStaysInItsRange) {
  EXPECT_EQ(wiped_limit(600), effect_info().buffer("wiped", "corrected").range[1]);
  EXPECT_LT(wiped_limit(4), wiped_limit(600));
}

TEST(SurfaceDeclared, FramesTogetherMakeTheTimeThatHasPassed) {
  SurfaceSettings s;
  s.corrected = true;
  for (const double fps : {23.976, 60.0, 144.0}) {
    s.fps = fps;
    double sum = 0;
    for (int frame = 0; frame < 2000; ++frame) sum += wipe_texture_uniforms(s, frame).dt;
    EXPECT_NEAR(sum, 2000 / fps, wiped_grid(s.mask_tau)) << fps;
  }
}

TEST(SurfaceDeclared, TheEdgeIsNoWiderThanABlade) {
  SurfaceSettings s;
  s.frame = {1.4, 0, 0.8};
  EXPECT_FLOAT_EQ(wipe_texture_uniforms(s, 0).edge_width, 1.4f / 1024);
  s.half_width = 1e-3;
  EXPECT_FLOAT_EQ(wipe_texture_uniforms(s, 0).edge_width, 1e-3f);
  s.half_width = 0;
  EXPECT_GT(wipe_texture_uniforms(s, 0).edge_width, 0) << "the pass divides by it";
}

}  // namespace
}  // namespace rainref::windshield
