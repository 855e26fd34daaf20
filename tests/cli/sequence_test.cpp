// Pictures that change from frame to frame: files with a number in their names, written here, so that what frame k holds is known.
#include <filesystem>

#include <nlohmann/json.hpp>

#include "cli/picture_files.h"
#include "effect/picture_sequence.h"
#include "image_io/read.h"
#include "math/half.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr int pictures = 4;

class Sequences : public SceneFiles {
 protected:
  Sequences() {
    std::filesystem::create_directory(folder / "film");
    for (int k = 0; k < pictures; ++k) {
      // Of both, no two frames are alike.
      put_npy(
          file("c", k), width, height, 3, [&](int x, int y, int c) { return code(x, y, c) - static_cast<float>(7 * k); }, true);
      put_npy(file("d", k), width, height, 1, [&](int x, int y, int c) { return metres(x + 2 * k, y, c) + static_cast<float>(k); });
    }
    const auto text = [&](const std::string& effect, const std::string& variant, bool has_depth, const std::string& rest) {
      std::string depth = has_depth ? "depth_image = 'film/d%02d.npy'\n" : "";
      if (effect == "edge_splash") depth += "source = 'files'\ndepth_encoding = 'metres'\n";
      put(folder / (effect + "-" + variant + ".toml"),
          fmt::format("effect = '{}'\nvariant = '{}'\n[run]\nframes = {}\nsize = [{}, {}]\n[scene]\nimage = 'film/c%02d.npy'\n{}{}", effect,
                      variant, pictures, width, height, depth, rest));
    };
    text("edge_splash", "as-published", true, "");
    text("edge_splash", "corrected", true, "[edge_splash]\nrain_drop_scale = 0\n");
    text("screen_drops", "as-published", false, "[drops]\ngrid = 0.1\n[noise]\nsize = 16\n");
    text("screen_drops", "corrected", false, "[drops]\nlargest_radius = 12\n[flow]\non = false\n");
    text("rainy_glass", "as-published", false, "[maps]\nsize = 16\ndroplets = 20\ntrails = 2\n");
    text("rainy_glass", "corrected", true, "[maps]\nsize = 16\ndroplets = 20\ntrails = 2\n");
    const std::string pane = "panes = '1.0 0.75 0.95, 1.9 0.8 1.0, 1.1 0.7 1.4'\nheight_size = [24, 14]\n";
    text("windshield", "as-published", true, "size = [24, 16]\n[windshield]\nspawn_rate = 3000\n" + pane);
    text("windshield", "corrected", true,
         "size = [24, 16]\n[rain]\nrate = 90\nsmallest_drop = 1\n[falling_rain]\non = true\nsmallest_drop = 3\nfar = 4\n[windshield]\n" +
             pane);
    before = folder.names();
  }
  std::filesystem::path file(const std::string& letter, int k) const { return folder / fmt::format("film/{}{:02}.npy", letter, k); }
  static bool has_depth(const std::string& scene) { return !scene.starts_with("screen_drops") && scene != "rainy_glass-as-published.toml"; }
  /// The scene with picture k alone.
  std::vector<std::string> hash_of_picture(const std::string& scene, int k, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{scene, "--set", fmt::format("scene.image=film/c{:02}.npy", k)};
    if (has_depth(scene)) all.insert(all.end(), {"--set", fmt::format("scene.depth_image=film/d{:02}.npy", k)});
    return hash(joined(all, more));
  }
  static std::vector<std::string> of_frame(const std::vector<std::string>& lines, int frame) {
    std::vector<std::string> out;
    for (const std::string& line : lines)
      if (line.starts_with(fmt::format("{} ", frame))) out.push_back(line.substr(line.find(' ') + 1));
    return out;
  }
  /// That frame n of a run shows picture shown[n].
  void expect_shown(const std::string& scene, const std::vector<int>& shown, const std::vector<std::string>& more) const {
    const std::vector<std::string> frames{"--frames", std::to_string(shown.size())};
    const auto lines = hash(joined(joined({scene}, more), frames));
    for (std::size_t n = 0; n < shown.size(); ++n) {
      const int frame = static_cast<int>(n);
      const auto single = hash_of_picture(scene, shown[n], frames);
      const auto wanted = of_frame(single, frame), found = of_frame(lines, frame);
      ASSERT_FALSE(wanted.empty());
      for (const std::string& line : wanted) EXPECT_THAT(found, Contains(line)) << scene << ", frame " << n;
      // What a still picture gives once, a film gives in each frame.
      if (scene.starts_with("screen_drops")) {
        EXPECT_EQ(found.front(), of_frame(single, 0).front()) << frame;
      }
    }
  }
};

class EverySequence : public Sequences, public testing::WithParamInterface<const char*> {};

TEST_P(EverySequence, FrameKIsTheSceneWithPictureK) {
  expect_shown(GetParam(), {0, 1, 2, 3}, {});
  const auto lines = hash({GetParam()});
  EXPECT_NE(of_frame(lines, 1).back(), of_frame(lines, 2).back());
  EXPECT_EQ(hash({GetParam(), "--threads", "3"}), lines);
  EXPECT_EQ(hash({GetParam(), "--simd", simd_targets().back()}), lines);
}
INSTANTIATE_TEST_SUITE_P(Scenes, EverySequence,
                         testing::Values("edge_splash-as-published.toml", "edge_splash-corrected.toml", "screen_drops-as-published.toml",
                                         "screen_drops-corrected.toml", "rainy_glass-as-published.toml", "rainy_glass-corrected.toml",
                                         "windshield-as-published.toml", "windshield-corrected.toml"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           name.resize(name.size() - 5);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

class EveryTracedSequence : public Sequences, public testing::WithParamInterface<const char*> {};

// Rays see the picture of their frame: traced, frame k is the traced scene with picture k.
TEST_P(EveryTracedSequence, FrameKIsTheSceneWithPictureK) {
  put(folder / GetParam(), contents(folder / GetParam()) + "[compositor]\npicture = 'traced'\n");
  expect_shown(GetParam(), {0, 1, 2, 3}, {});
  const auto lines = hash({GetParam()});
  EXPECT_THAT(lines, Contains(HasSubstr("compositor")));
  EXPECT_NE(of_frame(lines, 1).back(), of_frame(lines, 2).back());
}
INSTANTIATE_TEST_SUITE_P(Scenes, EveryTracedSequence,
                         testing::Values("screen_drops-corrected.toml", "rainy_glass-corrected.toml", "windshield-corrected.toml"),
                         [](const auto& tested) { return std::string(tested.param).substr(0, std::string(tested.param).find('-')); });

// The passes are compared with the truth of the same picture in each frame, here of one that stays black until frame 2.
TEST_F(Sequences, EachFrameIsComparedWithItsOwnTruth) {
  for (int k = 0; k < pictures; ++k)
    put_npy(folder / fmt::format("film/v{}.npy", k), width, height, 3, [&](int, int, int) { return k < 2 ? 0.0f : 0.25f; });
  const Outcome o = rainref({"run", "windshield-corrected.toml", "-o", "out", "--every", "1", "--image", "none", "--compare-truth", "--set",
                             "scene.image=film/v%d.npy", "--set", "falling_rain.on=false", "--set", "rain.rate=0", "--set",
                             "composite.glint_strength=0", "--set", "compositor.glass_thickness=1e-5"});
  ASSERT_EQ(o.code, 0) << o.err;
  const auto truth = nlohmann::json::parse(contents(folder / "out/summary.json"))["truth"];
  ASSERT_EQ(truth.size(), static_cast<std::size_t>(pictures));
  for (int k = 0; k < pictures; ++k) {
    const auto& film = truth.at(static_cast<std::size_t>(k))["differences"]["colour_film"];
    EXPECT_GT(film["pixels"], 0) << k;
    // At some 63 degrees to its normal the glass mirrors up to a quarter of the light away, which composite leaves out.
    EXPECT_LT(film["p50"], 0.3 * 0.25) << k;
  }
}

TEST_F(Sequences, FirstCountRateAndEndChooseThePicture) {
  const std::string scene = "edge_splash-corrected.toml";
  const auto set = [](std::vector<std::string> keys) {
    std::vector<std::string> all;
    for (std::string& k : keys) all.insert(all.end(), {"--set", "sequence." + k});
    return all;
  };
  expect_shown(scene, {2, 3}, set({"first=2"}));
  expect_shown(scene, {0, 1, 2, 3, 3, 3}, set({"end=hold"}));
  expect_shown(scene, {0, 1, 2, 3, 0, 1}, set({"end=loop"}));
  expect_shown(scene, {1, 2, 1, 2}, set({"first=1", "count=2", "end=loop"}));
  // Picture floor(n rate / fps): 24 a second at 60 frames, where frame 5 is picture 2 exactly.
  std::vector<std::string> film = set({"rate=24"});
  film.insert(film.end(), {"--set", "run.fps=60"});
  expect_shown(scene, {0, 0, 0, 1, 1, 2, 2, 2, 3, 3}, film);
}

// Without an edge a frame is its picture: sRGB code k of a flat picture, linear in the EXR.
TEST_F(Sequences, AFlatPictureIsItsOwnValue) {
  for (int k = 0; k < pictures; ++k) {
    put_npy(folder / fmt::format("film/v{}.npy", k), width, height, 3, [&](int, int, int) { return static_cast<float>(k + 1) / 8; });
    put_npy(folder / fmt::format("film/z{}.npy", k), width, height, 1, [&](int, int, int) { return 5.0f; });
  }
  const Outcome o = rainref({"run", "edge_splash-corrected.toml", "-o", "out", "--every", "1", "--image", "exr", "--set",
                             "scene.image=film/v%d.npy", "--set", "scene.depth_image=film/z%d.npy"});
  ASSERT_EQ(o.code, 0) << o.err;
  for (int k = 0; k < pictures; ++k) {
    const image_io::Picture shown = image_io::read(folder / fmt::format("out/edge_splash.{:04}.exr", k));
    ASSERT_EQ(shown.image.format(), Format::rgba16f);
    for (int y = 0; y < height; ++y) {
      for (int i = 0; i < 4 * width; ++i) ASSERT_EQ(to_float(shown.image.row<Half>(y)[i]), i % 4 == 3 ? 1 : static_cast<float>(k + 1) / 8);
    }
  }
}

TEST_F(Sequences, APackHoldsThePicturesOfItsFrames) {
  const Outcome o = rainref({"pack", "screen_drops-as-published.toml", "--at", "1,3", "-o", "pack"});
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* run : {"screen_drops.background/0001.0", "screen_drops.background/0003.0", "screen_drops.drops/0003.0"})
    EXPECT_TRUE(std::filesystem::exists(folder / "pack" / run)) << run;
  EXPECT_NE(contents(folder / "pack/screen_drops.background/0001.0/out.background.npy"),
            contents(folder / "pack/screen_drops.background/0003.0/out.background.npy"));
}

TEST_F(Sequences, TheSummaryNamesThemByTheirBytes) {
  const auto input = [&] {
    expect(rainref({"run", "edge_splash-corrected.toml", "-o", "out", "--frames", "1", "--image", "none"}), 0);
    return nlohmann::json::parse(contents(folder / "out/summary.json"))["inputs"];
  };
  const auto inputs = input();
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[0]["key"], "scene.image");
  EXPECT_EQ(inputs[0]["file"], "film/c%02d.npy");
  EXPECT_EQ(inputs[0]["first"], 0);
  EXPECT_EQ(inputs[0]["count"], pictures);
  EXPECT_FALSE(inputs[0].contains("decoded_hash"));
  // Of a file that this run does not show, too: the scene is another one.
  put_npy(
      file("c", 3), width, height, 3, [](int, int, int) { return 1.0f; }, true);
  const auto others = input();
  EXPECT_NE(others[0]["files_hash"], inputs[0]["files_hash"]);
  EXPECT_EQ(others[1], inputs[1]);
}

TEST_F(Sequences, WhatCannotBeShownIsRefusedAtTheStart) {
  const std::string scene = "edge_splash-corrected.toml", place = "edge_splash-corrected.toml:7:1: scene.image: ";
  expect_refused(
      scene, {"run.frames=5"},
      AllOf(HasSubstr(place), HasSubstr("run.frames 5: frame 4 needs 'film/c04.npy', found 4 pictures"), HasSubstr("sequence.end")));
  expect_refused(scene, {"sequence.count=6", "run.frames=2"},
                 AllOf(HasSubstr("scene.image: "), HasSubstr("film/c04.npy"), HasSubstr("No such file")), 4);
  expect_refused(scene, {"sequence.first=9"}, AllOf(HasSubstr("scene.image: "), HasSubstr("film/c09.npy"), HasSubstr("No such file")), 4);
  expect_refused(scene, {"scene.image=film/%02d-%02d.npy"}, HasSubstr("--set scene.image: 'film/%02d-%02d.npy': expected one number"));
  expect_refused(scene, {"scene.image=film/%s%02d.npy"}, HasSubstr("expected one number"));
  expect_refused(scene, {"scene.image=film/c00.npy", "scene.depth_image=film/d00.npy", "sequence.end=loop"},
                 HasSubstr("--set sequence.end: expected none where no picture's name holds a number"));
  expect_refused("windshield-corrected.toml", {"run.frames=5"}, HasSubstr("run.frames 5: frame 4 needs 'film/c04.npy', found 4 pictures"));
  expect_refused("windshield-corrected.toml", {"scene.image="}, HasSubstr("scene.depth_image: expected scene.image beside it, found none"));
  expect_refused("windshield-corrected.toml", {"scene.image=", "scene.depth_image=", "sequence.end=loop"},
                 HasSubstr("--set sequence.end: expected none where no picture's name holds a number, as \"%04d.png\" in scene.image or "
                           "scene.depth_image"));

  std::filesystem::remove(file("d", 3));
  for (const std::string& with_depth : {scene, std::string("windshield-corrected.toml")})
    expect_refused(with_depth, {"run.frames=2"}, HasSubstr("scene.depth_image: expected 4 pictures as scene.image has, found 3"));
  put_npy(file("d", 3), width, height - 1, 1, metres);
  expect_refused(scene, {"run.frames=2"},
                 HasSubstr("scene.depth_image: 'film/d03.npy': expected 24x16 texels as 'film/d00.npy' has, found 24x15"));
  put_npy(file("d", 3), width, height, 3, metres);
  expect_refused(scene, {"run.frames=2"},
                 HasSubstr("scene.depth_image: 'film/d03.npy': expected the channels Y as 'film/d00.npy' has, found R G B"));
  put(file("d", 3), "no array");
  expect_refused(scene, {"run.frames=2"}, AllOf(HasSubstr("scene.depth_image: "), HasSubstr("film/d03.npy': not an EXR, PNG")));
}

// A texel that no frame may have is found when its frame is read; what ran before it leaves no half-written file.
TEST_F(Sequences, ABadTexelNamesItsFile) {
  put_npy(file("d", 2), width, height, 1, [](int x, int y, int c) { return x == 3 && y == 0 ? std::nanf("") : metres(x, y, c); });
  expect_refused("edge_splash-corrected.toml", {},
                 AllOf(HasSubstr("scene.depth_image: "), HasSubstr("film/d02.npy': NaN at x 3, y 0 (from the top)")));
  put_npy(file("d", 2), width, height, 1, [](int x, int y, int c) { return x == 3 && y == 0 ? -1.0f : metres(x, y, c); });
  for (const char* scene : {"edge_splash-corrected.toml", "rainy_glass-corrected.toml", "windshield-corrected.toml"})
    expect_refused(scene, {},
                   AllOf(HasSubstr("scene.depth_image: expected depths of 0 m or more, found -1"), HasSubstr("(in 'film/d02.npy')")));
}

TEST_F(Sequences, PngAndExrAreLookedAtWithoutDecoding) {
  for (int k = 0; k < 3; ++k) {
    image_io::write_png(folder / fmt::format("film/p{}.png", k), image_of(Format::rgba8, width, height, [&](int x, int y, int c) {
                          return c == 3 ? 255.0f : code(x, y, c) - static_cast<float>(7 * k);
                        }));
    const Image depth =
        image_of(Format::rgba32f, width, height, [&](int x, int y, int c) { return metres(x + 2 * k, y, c) + static_cast<float>(k); });
    image_io::write_exr(folder / fmt::format("film/p{}.exr", k), {{"", {"R", "G", "B"}, &depth}});
  }
  const std::string scene = "edge_splash-corrected.toml";
  EXPECT_EQ(hash({scene, "--frames", "3", "--set", "scene.image=film/p%d.png", "--set", "scene.depth_image=film/p%d.exr"}),
            hash({scene, "--frames", "3"}));
}

TEST(SequenceNames, AreThoseOfPrintf) {
  using effect::is_sequence;
  using effect::numbered;
  EXPECT_FALSE(is_sequence("a.png"));
  EXPECT_FALSE(is_sequence("100%.png"));
  EXPECT_FALSE(is_sequence("%%04d.png"));
  EXPECT_FALSE(is_sequence("%f.png"));
  EXPECT_TRUE(is_sequence("%d.png"));
  EXPECT_EQ(numbered("%d.png", 12), "12.png");
  EXPECT_EQ(numbered("a/%04d.exr", 12), "a/0012.exr");
  EXPECT_EQ(numbered("%4d", 12), "  12");
  EXPECT_EQ(numbered("%02d", 12345), "12345");
  EXPECT_EQ(numbered("50%%/%1d%%", 3), "50%/3%");
}

}  // namespace
}  // namespace rainref::cli
