// One number a texel from files of several channels.
#include <nlohmann/json.hpp>

#include "cli/picture_files.h"
#include "image_io/read.h"
#include "math/half.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A scene of each effect that takes a depth in metres from `depth.exr` (SceneFiles).
class Quantities : public SceneFiles {
 protected:
  static constexpr const char* with_depth[] = {"edge_splash.toml", "rainy_glass.toml", "windshield.toml"};

  Quantities() {
    const auto text = [&](const std::string& effect, const std::string& scene, const std::string& rest) {
      put(folder / (effect + ".toml"),
          fmt::format("effect = '{}'\nvariant = 'corrected'\n[run]\nframes = 2\nsize = [{}, {}]\n[scene]\nimage = 'colour.png'\n"
                      "depth_image = 'depth.exr'\n{}{}",
                      effect, width, height, scene, rest));
    };
    text("edge_splash", "source = 'files'\ndepth_encoding = 'metres'\n", "[edge_splash]\nrain_drop_scale = 0\n");
    text("rainy_glass", "", "[maps]\nsize = 16\ndroplets = 20\ntrails = 2\n");
    text("windshield", "", "[windshield]\nheight_size = [24, 16]\n[blur]\nfog_density = 0.002\n");
    before = folder.names();
  }
  /// The scene's depth beside colours that are none.
  void put_beside_colours(const std::string& file, const std::string& prefix, const std::string& channel) const {
    const Image colours = image_of(Format::rgba32f, width, height, code), depth = image_of(Format::rgba32f, width, height, metres);
    image_io::write_exr(folder / file, {{"", {"R", "G", "B", "A"}, &colours}, {prefix, {channel}, &depth}});
  }
  Outcome hashed(const std::string& scene, const std::vector<std::string>& sets) const {
    std::vector<std::string> all{"hash", scene};
    for (const std::string& s : sets) all.insert(all.end(), {"--set", s});
    Circumstances c;
    c.is_copy = true;
    return rainref(all, c);
  }
};

// Red was taken, whatever it held.
TEST_F(Quantities, ADepthBesideColoursIsTakenAndSaid) {
  put_beside_colours("beside.exr", "", "Z");
  put_beside_colours("blender.exr", "Depth", "V");
  for (const char* scene : with_depth) {
    SCOPED_TRACE(scene);
    const std::string expected = hashed(scene, {}).out;
    const Outcome beside = hashed(scene, {"scene.depth_image=beside.exr"}), blender = hashed(scene, {"scene.depth_image=blender.exr"});
    EXPECT_EQ(beside.code, 0);
    EXPECT_EQ(beside.out, expected);
    EXPECT_EQ(beside.err, "rainref: note: scene.depth_image: 'beside.exr': channel Z of R G B A Z is taken\n");
    EXPECT_EQ(blender.out, expected);
    EXPECT_THAT(blender.err, HasSubstr("channel Depth.V of R G B A Depth.V is taken"));
  }
}

TEST_F(Quantities, TheSummarySaysTheChannel) {
  put_beside_colours("beside.exr", "", "Z");
  const auto channels = [&](const std::string& depth) {
    const Outcome o = rainref({"run", "edge_splash.toml", "-o", "of_" + depth, "--image", "none", "--set", "scene.depth_image=" + depth});
    EXPECT_EQ(o.code, 0) << o.err;
    const auto inputs = nlohmann::json::parse(contents(folder / ("of_" + depth + "/summary.json")))["inputs"];
    EXPECT_FALSE(inputs[0].contains("channel")) << "colours";
    return inputs[1]["channel"].get<std::string>();
  };
  EXPECT_EQ(channels("beside.exr"), "Z");
  EXPECT_EQ(channels("depth.exr"), "R");
  EXPECT_EQ(channels("depth.npy"), "Y");
}

TEST_F(Quantities, ASequenceTakesTheChannelOfItsFirstFile) {
  put_beside_colours("z0.exr", "", "Z");
  put_beside_colours("z1.exr", "", "Z");
  for (const char* scene : with_depth) {
    const Outcome o = hashed(scene, {"scene.depth_image=z%d.exr"});
    EXPECT_EQ(o.out, hashed(scene, {}).out) << scene;
    EXPECT_EQ(o.err, "rainref: note: scene.depth_image: 'z%d.exr': channel Z of R G B A Z is taken\n");
  }
}

TEST_F(Quantities, UnlikeColoursAreRefused) {
  const Image colours = image_of(Format::rgba32f, width, height, code);
  image_io::write_exr(folder / "colours.exr", {{"", {"R", "G", "B", "A"}, &colours}});
  put_npy(folder / "colours.npy", width, height, 3, code);
  const auto unlike = [](const char* key, const char* file) {
    return AllOf(HasSubstr(fmt::format("{}: '{}': expected one quantity, found R 30 beside G 70 at x 0, y 0 (from the top)", key, file)));
  };
  for (const char* scene : with_depth) {
    for (const char* file : {"colours.exr", "colours.npy"})
      expect_refused(scene, {fmt::format("scene.depth_image={}", file)}, unlike("scene.depth_image", file));
  }
  for (const char* key : {"scene.layer_image", "scene.noise_image"})
    expect_refused("edge_splash.toml", {fmt::format("{}=colours.exr", key)}, unlike(key, "colours.exr"));
  expect_refused("corrected.toml", {"rain.shelter_image=colours.exr"}, unlike("rain.shelter_image", "colours.exr"));
  // A depth's name is none of theirs.
  put_beside_colours("beside.exr", "", "Z");
  expect_refused("edge_splash.toml", {"scene.layer_image=beside.exr"}, unlike("scene.layer_image", "beside.exr"));
}

}  // namespace
}  // namespace rainref::cli
