// Traced pictures of every effect that has them, and its passes against them (`run --compare-truth`), as a user meets them.
#include <map>

#include <nlohmann/json.hpp>

#include "cli/picture_files.h"
#include "image_io/read.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class Truth : public CommandLine {
 protected:
  Truth() {
    const std::string pane = "[run]\nframes = 2\nsize = [96, 54]\n";
    put(folder / "screen_drops.toml", "effect = 'screen_drops'\nvariant = 'corrected'\n" + pane +
                                          "[glass]\nheight = 0.04\n[rain]\nrate = 100\n[flow]\nwarm_up = 10\nheight_size = [160, 90]\n");
    put(folder / "rainy_glass.toml", "effect = 'rainy_glass'\nvariant = 'corrected'\n" + pane + "[maps]\nsize = 128\n");
    const std::string car =
        "effect = 'windshield'\n[run]\nframes = 30\nfps = 10\nsize = [96, 54]\n[vehicle]\nspeed = 0\n[wipers]\ncount = 0\n"
        "[windshield]\nheight_size = [160, 93]\n[scene]\nsize = [64, 36]\nmoves = false\n[camera]\nvertical_fov_deg = 8\n";
    put(folder / "windshield.toml", "variant = 'corrected'\n" + car + "[rain]\nrate = 150\nsmallest_drop = 1.5\n");
    put(folder / "windshield_published.toml", "variant = 'as-published'\n" + car);
    before = folder.names();
  }
  nlohmann::json summary(const std::string& in) const { return nlohmann::json::parse(contents(folder / (in + "/summary.json"))); }
  /// Runs scene.toml into a folder of its own.
  void run(const std::string& scene, const std::string& to, const std::vector<std::string>& more) const {
    const Outcome o = rainref(joined({"run", scene + ".toml", "-o", to}, more));
    ASSERT_EQ(o.code, 0) << o.err;
  }
  /// The buffers of the traced picture with their hashes.
  std::map<std::string, std::string> trace(const std::string& scene, const std::string& to, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--image", "none", "--set", "compositor.picture=traced"});
    run(scene, to, more);
    std::map<std::string, std::string> out;
    const nlohmann::json written = summary(to);  // a loop over a part of it would not keep it alive
    for (const auto& line : written["last_frame"])
      if (line["pass"] == "compositor") out[line["buffer"]] = line["xxh3"];
    return out;
  }
  /// Percentiles in order and a picture of each difference, which counts pixels.
  void expect_differences(const nlohmann::json& truth, const std::string& in, const std::vector<std::string>& names, int width) const {
    for (const std::string& name : names) {
      SCOPED_TRACE(in + " " + name);
      const nlohmann::json& d = truth["differences"][name];
      // Texels of 9 mm may leave no pixel of the windshield without water.
      if (name != "refraction_film") {
        EXPECT_GT(d["pixels"], 0);
      }
      EXPECT_LE(d["p50"], d["p90"]);
      EXPECT_LE(d["p99"], d["max"]);
      EXPECT_EQ(image_io::read(folder / in / d["picture"].get<std::string>()).image.width(), width);
    }
  }
  void expect_channels(const std::string& picture) const {
    EXPECT_THAT(image_io::read(folder / picture).channel_names,
                IsSupersetOf({"R", "G", "B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "film", "mask"}));
  }
  void expect_refused(const std::string& scene, const std::vector<std::string>& sets, const std::string& message,
                      const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{"run", scene + ".toml", "-o", "o"};
    for (const std::string& s : sets) all.insert(all.end(), {"--set", s});
    expect_refusal(joined(all, more), 2, HasSubstr(message));
  }
};

TEST_F(Truth, TracedPicturesComeWithNamedChannels) {
  run("corrected", "o", {"--image", "both", "--set", "compositor.picture=traced", "--set", "compositor.samples=4"});
  expect_channels("o/puddle.0001.exr");
  EXPECT_EQ(image_io::read(folder / "o/puddle.0001.exr").image.format(), Format::rgba16f);
}

TEST_F(Truth, EmbreesConfigurationAndThreadsChangeNoBit) {
  const std::map<std::string, std::vector<std::string>> changes{
      {"corrected", {"compositor.depth=1"}},
      {"screen_drops", {"compositor.glass_thickness=0.02"}},
      {"rainy_glass", {"compositor.glass_thickness=0.02"}},
      {"windshield", {"compositor.glass_radius=3", "compositor.glass_thickness=0.02"}}};
  for (const auto& [scene, settings] : changes) {
    SCOPED_TRACE(scene);
    const auto first = trace(scene, scene + "_a");
    EXPECT_EQ(first.size(), 6u);
    EXPECT_EQ(trace(scene, scene + "_b", {"--set", "compositor.embree_config=isa=sse2", "--threads", "1"}), first);
    EXPECT_EQ(trace(scene, scene + "_c", {"--set", "compositor.embree_config=isa=avx2", "--threads", "3", "--simd", simd_targets().back()}),
              first);
    for (std::size_t k = 0; k < settings.size(); ++k)
      EXPECT_NE(trace(scene, fmt::format("{}_d{}", scene, k), {"--set", settings[k]}), first) << settings[k];
  }
}

TEST_F(Truth, ThePuddlesPassesAreComparedInEachFrame) {
  run("corrected", "o", {"--compare-truth", "--every", "1"});
  const nlohmann::json truth = summary("o")["truth"];
  ASSERT_EQ(truth.size(), 2u);
  for (int frame = 0; frame < 2; ++frame) {
    EXPECT_EQ(truth[frame]["frame"], frame);
    EXPECT_EQ(truth[frame]["pixels"], 24 * 16);
    expect_differences(truth[frame], "o",
                       {"hit_distance", "normal_angle", "ground_offset", "colour", "display", "ground_display", "schlick"}, 24);
  }
}

TEST_F(Truth, ThePassesOfPanesAreCompared) {
  const std::map<std::string, std::vector<std::string>> names{{"screen_drops", {"refraction", "colour", "colour_dry", "display"}},
                                                              {"rainy_glass", {"refraction", "bend", "colour", "colour_dry", "display"}}};
  for (const auto& [effect, differences] : names) {
    run(effect, effect, {"--compare-truth", "--image", "both", "--set", "compositor.picture=traced"});
    const nlohmann::json truth = summary(effect)["truth"].at(0);
    EXPECT_EQ(truth["pixels"], 96 * 54);
    EXPECT_GT(truth["wet_pixels"], 100) << effect;
    expect_differences(truth, effect, differences, 96);
    expect_channels(effect + "/" + effect + ".0001.exr");
  }
}

TEST_F(Truth, TheWindshieldsCompositeIsComparedInBothVariants) {
  for (const std::string scene : {"windshield", "windshield_published"}) {
    run(scene, scene, {"--set", "compositor.glass_thickness=1e-4", "--compare-truth"});
    const nlohmann::json truth = summary(scene)["truth"].at(0);
    EXPECT_EQ(truth["glass_pixels"], 96 * 54);
    EXPECT_GT(truth["drop_pixels"], 10) << scene;
    expect_differences(truth, scene, {"refraction", "refraction_film", "colour", "colour_film", "display"}, 96);
  }
}

// Without water and with hardly any glass there is nothing to refract: both see the street, or a picture in its place, where it is.
TEST_F(Truth, TheWindshieldsAgreesWhereThereIsNothingToRefract) {
  put_npy(folder / "view.npy", 40, 24, 3, [](int x, int y, int c) { return 0.1f + 0.01f * static_cast<float>(x + 2 * y + 3 * c); });
  put_npy(folder / "wall.npy", 40, 24, 1, [](int, int, int) { return 9.0f; });
  for (const auto& [image, depth] : {std::pair{"", ""}, {"view.npy", ""}, {"view.npy", "wall.npy"}}) {
    run("windshield", "o",
        {"--frames", "1", "--set", "rain.rate=0", "--set", "compositor.glass_thickness=1e-5", "--compare-truth", "--set",
         std::string("scene.image=") + image, "--set", std::string("scene.depth_image=") + depth});
    const nlohmann::json truth = summary("o")["truth"].at(0), &film = truth["differences"]["refraction_film"];
    EXPECT_EQ(truth["drop_pixels"], 0);
    EXPECT_EQ(film["pixels"], 96 * 54);
    EXPECT_LT(film["max"], 1e-3);  // float uniforms on one side, 10 um of glass 1 m from the eye on the other
  }
}

TEST_F(Truth, WhatCannotBeTracedOrComparedIsRefused) {
  const std::vector<std::string> compared{"--compare-truth"};
  const std::string traced = "compositor.picture=traced", thick = "compositor.glass_thickness=0.09";
  expect_refused("published", {}, "--compare-truth: puddle as-published has no traced truth", compared);
  expect_refused("published", {traced}, "compositor.picture");
  expect_refused("corrected", {traced, "compositor.samples=3"}, "--set compositor.samples: expected 1, 4, 8 or 16 [1], found 3");
  expect_refused("corrected", {"compositor.samples=32"}, "--set compositor.samples: expected 1, 4, 8 or 16 [1], found 32");
  expect_refused("corrected", {"compositor.picture=painted"}, "'passes', 'traced'");
  expect_refused("corrected", {traced, "compositor.surroundings=street"}, "compositor.surroundings: expected \"picture\"");
  expect_refused("rainy_glass", {"scene.panorama=sky.png", traced}, "and depths, which scene.panorama has not");
  expect_refused("rainy_glass", {"glass.shape=sphere"}, "has no traced truth", compared);
  expect_refused("rainy_glass", {"glass.shape=sphere", traced}, "compositor.picture: expected \"passes\"");
  expect_refused("screen_drops", {thick}, "compositor.glass_thickness: expected less than", compared);
  expect_refused("screen_drops", {thick, traced}, "compositor.glass_thickness: expected less than");
  expect_refused("rainy_glass", {"glass.distance=0.02", "compositor.glass_thickness=0.02"},
                 "compositor.glass_thickness: expected less than", compared);
  expect_refused("windshield", {traced, "compositor.glass_radius=0.1"}, "pane: expected a radius");
}

// Packs and captures are of passes: nothing of the compositor is in them.
TEST_F(Truth, PacksKnowNothingOfIt) {
  run("corrected", "o", {"--capture", "all", "--image", "none", "--set", "compositor.picture=traced"});
  EXPECT_THAT(contents(folder / "o/capture/manifest.json"), Not(HasSubstr("compositor")));
  EXPECT_THAT(rainref({"describe", "puddle"}).out, HasSubstr("compositor.embree_config"));
}

}  // namespace
}  // namespace rainref::cli
