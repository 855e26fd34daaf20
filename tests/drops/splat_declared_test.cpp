// What splat declares: scene keys behind a prefix, uniforms.
#include <gtest/gtest.h>

#include "config_of.h"
#include "drops/splat/splat.h"
#include "rainref/error.h"

namespace rainref {
namespace {

const std::vector<scene::Parameter>& keys() {
  static const std::vector<scene::Parameter> all = drops::splat_parameters("pane");
  return all;
}
scene::Config config(const std::string& variant, const std::vector<std::string>& values) {
  return test::config_of("pane", keys(), variant, "", values);
}

TEST(SplatDeclared, ScenesSetWhatTheVariantUses) {
  const std::vector<std::string> variants{"as-published", "corrected"};
  scene::validate(keys(), variants);
  const drops::SplatKeys published =
      drops::splat_keys(config("as-published", {"pane.kernel=disc", "pane.blend=max", "pane.rounding=rtz", "pane.accumulate=float",
                                                "pane.drop_radius=0.01", "pane.drop_height=2", "pane.height_size=[320, 200]"}),
                        "pane");
  EXPECT_EQ(published.kernel, drops::SplatKernel::disc);
  EXPECT_EQ(published.blend, drops::SplatBlend::max);
  EXPECT_EQ(published.rounding, Rounding::rtz);
  EXPECT_FALSE(published.half_accumulation);
  EXPECT_EQ(published.drop_radius, 0.01);
  EXPECT_EQ(published.drop_height, 2);
  EXPECT_EQ(published.width, 320);
  EXPECT_EQ(published.height, 200);
  EXPECT_TRUE(drops::splat_keys(config("as-published", {}), "pane").half_accumulation);
  const drops::SplatKeys corrected = drops::splat_keys(config("corrected", {"pane.smallest_radius=2"}), "pane");
  EXPECT_FALSE(corrected.half_accumulation);
  EXPECT_EQ(corrected.smallest_radius, 2);
  EXPECT_THROW(config("corrected", {"pane.accumulate=half"}), Error);
}

// A port learns from the uniforms alone whether each drop is rounded.
TEST(SplatDeclared, TheUniformsSayHowDropsJoin) {
  const auto blend = [](bool corrected, bool half, drops::SplatBlend wanted) {
    drops::SplatSettings s;
    s.corrected = corrected;
    s.keys.half_accumulation = half;
    s.keys.blend = wanted;
    return static_cast<drops::SplatBlend>(drops::splat_uniforms(s).blend);
  };
  using enum drops::SplatBlend;
  EXPECT_EQ(blend(false, true, add), add_in_half);
  EXPECT_EQ(blend(false, false, add), add);
  EXPECT_EQ(blend(true, false, add), add);
  EXPECT_EQ(blend(false, true, max), max) << "the largest half is the half of the largest";
}

}  // namespace
}  // namespace rainref
