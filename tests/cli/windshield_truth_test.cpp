// The windshield's traced pictures and its composite against them, as a user meets them.
#include "cli/picture_files.h"
#include "cli/traced_pictures.h"
#include "image_io/read.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;

class WindshieldTruth : public TracedPictures {
 protected:
  WindshieldTruth() {
    for (const char* variant : {"corrected", "as-published"}) {
      put(folder / (std::string(variant) + ".toml"), std::string("effect = \"windshield\"\nvariant = \"") + variant + R"("
[run]
frames = 30
fps = 10
size = [96, 54]
[vehicle]
speed = 0
[wipers]
count = 0
[windshield]
height_size = [160, 93]
[scene]
size = [64, 36]
moves = false
[camera]
vertical_fov_deg = 8
)");
    }
    put(folder / "corrected.toml", contents(folder / "corrected.toml") + "[rain]\nrate = 150\nsmallest_drop = 1.5\n");
    before = folder.names();
  }
};

TEST_F(WindshieldTruth, EmbreesConfigurationAndThreadsChangeNoBit) {
  const auto first = trace("corrected", "a");
  EXPECT_EQ(first.size(), 6u);
  EXPECT_EQ(trace("corrected", "b", {"--set", "compositor.embree_config=isa=sse2", "--threads", "1"}), first);
  EXPECT_EQ(trace("corrected", "c", {"--set", "compositor.embree_config=isa=avx2", "--threads", "3", "--simd", simd_targets().back()}),
            first);
  EXPECT_NE(trace("corrected", "d", {"--set", "compositor.glass_radius=3"}), first);
  EXPECT_NE(trace("corrected", "e", {"--set", "compositor.glass_thickness=0.02"}), first);
}

TEST_F(WindshieldTruth, CompositeIsComparedInBothVariants) {
  for (const std::string variant : {"corrected", "as-published"}) {
    const Outcome o = rainref({"run", variant + ".toml", "-o", variant, "--set", "compositor.glass_thickness=1e-4", "--compare-truth"});
    ASSERT_EQ(o.code, 0) << o.err;
    const nlohmann::json truth = summary(variant)["truth"].at(0);
    EXPECT_EQ(truth["glass_pixels"], 96 * 54);
    EXPECT_GT(truth["drop_pixels"], 10) << variant;
    for (const char* name : {"refraction", "refraction_film", "colour", "colour_film", "display"}) {
      const nlohmann::json d = truth["differences"][name];
      // Texels of 9 mm may leave no pixel without water.
      if (name != std::string("refraction_film")) {
        EXPECT_GT(d["pixels"], 0) << name;
      }
      EXPECT_LE(d["p50"], d["p90"]);
      EXPECT_LE(d["p99"], d["max"]);
      EXPECT_TRUE(std::filesystem::exists(folder / variant / d["picture"].get<std::string>()));
    }
  }
}

// Without water and with hardly any glass there is nothing to refract: both see the street where it is.
TEST_F(WindshieldTruth, AgreeWhereThereIsNothingToRefract) {
  const Outcome o = rainref({"run", "corrected.toml", "-o", "o", "--frames", "1", "--set", "rain.rate=0", "--set",
                             "compositor.glass_thickness=1e-5", "--compare-truth"});
  ASSERT_EQ(o.code, 0) << o.err;
  const nlohmann::json truth = summary("o")["truth"].at(0);
  EXPECT_EQ(truth["drop_pixels"], 0);
  const nlohmann::json film = truth["differences"]["refraction_film"];
  EXPECT_EQ(film["pixels"], 96 * 54);
  EXPECT_LT(film["max"], 1e-3);  // float uniforms on one side, 10 um of glass 1 m from the eye on the other
}

// The same of a picture in the street's place, which both see where it is: the camera's view and no other.
TEST_F(WindshieldTruth, AgreeOnPicturesWhereThereIsNothingToRefract) {
  put_npy(folder / "sky.npy", 40, 24, 3, [](int x, int y, int c) { return 0.1f + 0.01f * static_cast<float>(x + 2 * y + 3 * c); });
  put_npy(folder / "wall.npy", 40, 24, 1, [](int, int, int) { return 9.0f; });
  for (const char* depth : {"", "wall.npy"}) {
    const Outcome o =
        rainref({"run", "corrected.toml", "-o", "o", "--frames", "1", "--set", "rain.rate=0", "--set", "compositor.glass_thickness=1e-5",
                 "--compare-truth", "--set", "scene.image=sky.npy", "--set", std::string("scene.depth_image=") + depth});
    ASSERT_EQ(o.code, 0) << o.err;
    const nlohmann::json film = summary("o")["truth"].at(0)["differences"]["refraction_film"];
    EXPECT_EQ(film["pixels"], 96 * 54);
    EXPECT_LT(film["max"], 1e-3);
  }
}

TEST_F(WindshieldTruth, WhatCannotBeTracedIsRefused) {
  expect_refusal({"run", "corrected.toml", "-o", "o", "--set", "compositor.picture=traced", "--set", "compositor.glass_radius=0.1"}, 2,
                 HasSubstr("pane: expected a radius"));
}

}  // namespace
}  // namespace rainref::cli
