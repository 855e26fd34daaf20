// The traced panes of screen_drops and rainy_glass, and their passes against them, as a user meets them.
#include "cli/traced_pictures.h"
#include "image_io/read.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

class PaneTruth : public TracedPictures {
 protected:
  PaneTruth() {
    put(folder / "screen_drops.toml",
        "effect = 'screen_drops'\nvariant = 'corrected'\n[run]\nframes = 2\nsize = [96, 54]\n[glass]\nheight = 0.04\n[rain]\nrate = "
        "100\n[flow]\nwarm_up = 10\nheight_size = [160, 90]\n");
    put(folder / "rainy_glass.toml",
        "effect = 'rainy_glass'\nvariant = 'corrected'\n[run]\nframes = 2\nsize = [96, 54]\n[maps]\nsize = 128\n");
    before = folder.names();
  }
};

TEST_F(PaneTruth, EmbreesConfigurationAndThreadsChangeNoBit) {
  for (const std::string effect : {"screen_drops", "rainy_glass"}) {
    const auto first = trace(effect, effect + "_a");
    EXPECT_EQ(first.size(), 6u);
    EXPECT_EQ(
        trace(effect, effect + "_b", {"--set", "compositor.embree_config=isa=sse2", "--threads", "3", "--simd", simd_targets().back()}),
        first);
    EXPECT_NE(trace(effect, effect + "_c", {"--set", "compositor.glass_thickness=0.02"}), first);
  }
}

TEST_F(PaneTruth, PassesAreComparedWithIt) {
  const std::map<std::string, std::vector<const char*>> names{{"screen_drops", {"refraction", "colour", "colour_dry", "display"}},
                                                              {"rainy_glass", {"refraction", "bend", "colour", "colour_dry", "display"}}};
  for (const auto& [effect, differences] : names) {
    const Outcome o =
        rainref({"run", effect + ".toml", "-o", effect, "--compare-truth", "--image", "both", "--set", "compositor.picture=traced"});
    ASSERT_EQ(o.code, 0) << o.err;
    const nlohmann::json truth = summary(effect)["truth"].at(0);
    EXPECT_EQ(truth["pixels"], 96 * 54);
    EXPECT_GT(truth["wet_pixels"], 100) << effect;
    for (const char* name : differences) {
      const nlohmann::json d = truth["differences"][name];
      EXPECT_GT(d["pixels"], 0) << name;
      EXPECT_LE(d["p50"], d["p90"]);
      EXPECT_LE(d["p99"], d["max"]);
      EXPECT_TRUE(std::filesystem::exists(folder / effect / d["picture"].get<std::string>()));
    }
    const image_io::Picture exr = image_io::read(folder / effect / (effect + ".0001.exr"));
    EXPECT_THAT(exr.channel_names, IsSupersetOf({"R", "G", "B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "film", "mask"}));
  }
}

TEST_F(PaneTruth, WhatCannotBeTracedIsRefused) {
  expect_refusal({"run", "rainy_glass.toml", "-o", "o", "--set", "scene.panorama=sky.png", "--set", "compositor.picture=traced"}, 2,
                 HasSubstr("and depths, which scene.panorama has not"));
  expect_refusal({"run", "rainy_glass.toml", "-o", "o", "--set", "glass.shape=sphere", "--compare-truth"}, 2,
                 HasSubstr("has no traced truth"));
  expect_refusal({"run", "rainy_glass.toml", "-o", "o", "--set", "glass.shape=sphere", "--set", "compositor.picture=traced"}, 2,
                 HasSubstr("compositor.picture: expected \"passes\""));
  expect_refusal({"run", "screen_drops.toml", "-o", "o", "--set", "compositor.glass_thickness=0.09", "--compare-truth"}, 2,
                 HasSubstr("compositor.glass_thickness: expected less than"));
  expect_refusal({"run", "screen_drops.toml", "-o", "o", "--set", "compositor.glass_thickness=0.09", "--set", "compositor.picture=traced"},
                 2, HasSubstr("compositor.glass_thickness: expected less than"));
  expect_refusal(
      {"run", "rainy_glass.toml", "-o", "o", "--set", "glass.distance=0.02", "--set", "compositor.glass_thickness=0.02", "--compare-truth"},
      2, HasSubstr("compositor.glass_thickness: expected less than"));
}

}  // namespace
}  // namespace rainref::cli
