// One number a texel from files of several channels, and what a depth in metres means: the same in every effect.
#include <nlohmann/json.hpp>

#include "cli/picture_files.h"
#include "image_io/read.h"
#include "math/half.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr float infinity = std::numeric_limits<float>::infinity();

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
    return copied(all);
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
    expect(rainref({"run", "edge_splash.toml", "-o", "of_" + depth, "--image", "none", "--set", "scene.depth_image=" + depth}), 0);
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

// What engines, Blender, halves and range finders write where nothing stands.
TEST_F(Quantities, TheSkyOfADepthInMetresIsFarInEveryEffect) {
  const auto put_sky = [&](const std::string& file, float sky, float scale = 1) {
    put_npy(folder / file, width, height, 1, [=](int x, int y, int c) { return y < 3 ? sky : metres(x, y, c) / scale; });
  };
  put_sky("far.npy", 1000);
  put_sky("infinity.npy", infinity);
  put_sky("blender.npy", 1e10f);
  put_sky("half.npy", 65504);
  put_sky("nothing.npy", 0);
  const Image depth = image_of(Format::rgba32f, width, height, [](int x, int y, int c) { return y < 3 ? infinity : metres(x, y, c); });
  image_io::write_exr(folder / "infinity.exr", {{"", {"Z"}, &depth}});
  // In centimetres the largest half is 655 m.
  put_sky("centimetres.npy", 65504, 0.01f);
  for (const char* scene : with_depth) {
    SCOPED_TRACE(scene);
    const auto with = [&](const std::string& file, std::vector<std::string> more = {}) {
      more.insert(more.begin(), "scene.depth_image=" + file);
      const Outcome o = hashed(scene, more);
      EXPECT_EQ(o.code, 0) << file << ": " << o.err;
      EXPECT_EQ(o.err, "");
      return o.out;
    };
    const std::string far = with("far.npy");
    for (const char* file : {"infinity.npy", "infinity.exr", "blender.npy", "half.npy", "nothing.npy"}) EXPECT_EQ(with(file), far) << file;
    EXPECT_EQ(with("centimetres.npy", {"scene.depth_scale=0.01"}), far);
    expect_refused(scene, {"scene.depth_image=holed.npy"}, HasSubstr("NaN at x 3, y 2"));
  }
  EXPECT_NE(hashed("edge_splash.toml", {}).out, hashed("edge_splash.toml", {"scene.depth_image=far.npy"}).out);
  EXPECT_NE(hashed("windshield.toml", {}).out, hashed("windshield.toml", {"scene.depth_image=far.npy"}).out);
  // The far plane of edge_splash may be no float.
  EXPECT_EQ(hashed("edge_splash.toml", {"scene.depth_image=infinity.npy", "scene.far=300.1"}).code, 0);
  // A depth beyond it that nobody writes for a sky is still a mistake, and so is a device depth that is none.
  expect_refused("edge_splash.toml", {"scene.far=30"}, HasSubstr("found 40 at column 0, row 8 from the bottom"));
  expect_refused("edge_splash.toml", {"scene.depth_encoding=device", "scene.depth_image=infinity.npy"},
                 HasSubstr("expected device depths from 0 to 1, found 2"));
}

TEST_F(Quantities, ARadiancePicturesExposureIsDividedOut) {
  const auto hdr = [&](const std::string& file, int exponent, const std::string& lines) {
    put(folder / file, image_io::hdr(8, 4, std::vector<std::array<int, 4>>(32, {128, 64, 32, exponent}), "-Y {h} +X {w}", lines));
  };
  hdr("plain.hdr", 128, "");
  hdr("exposed.hdr", 129, "EXPOSURE=2.0\n");
  const Outcome plain = hashed("corrected.toml", {"environment.image=plain.hdr"}),
                exposed = hashed("corrected.toml", {"environment.image=exposed.hdr"});
  EXPECT_EQ(plain.err, "");
  EXPECT_EQ(exposed.out, plain.out);
  EXPECT_EQ(exposed.err,
            "rainref: note: environment.image: 'exposed.hdr': its pixels are divided by 2, 2 and 2, by which its header says they were "
            "multiplied\n");
  hdr("wrong.hdr", 129, "EXPOSURE=0\n");
  expect_refused("corrected.toml", {"environment.image=wrong.hdr"},
                 HasSubstr("environment.image: 'wrong.hdr': EXPOSURE: expected a number above 0, found '0'"));
}

}  // namespace
}  // namespace rainref::cli
