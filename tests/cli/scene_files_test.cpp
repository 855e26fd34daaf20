// Scenes of files, of every effect: which files are the same scene, what of them is seen, what is doubted, what is refused.
#include <sys/stat.h>

#include "cli/picture_files.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// splash.toml, glass.toml, drive.toml and drops.toml as corrected, printed_glass.toml and printed_drops.toml as published.
class FilesOfScenes : public SceneFiles {
 protected:
  FilesOfScenes() {
    // A step at the seam.
    image_io::write_png(folder / "noise.png", image_of(Format::rgba8, 8, 8, [](int, int y, int) { return y == 7 ? 250.0f : 10.0f; }));
    put(folder / "text.npy", "not an array");
    const auto scene = [&](const char* name, const char* effect, const char* variant, const char* rest) {
      put(folder / name, fmt::format("effect = '{}'\nvariant = '{}'\n[run]\nframes = 2\nsize = [{}, {}]\n[scene]\nimage = 'colour.png'\n{}",
                                     effect, variant, width, height, rest));
    };
    scene("splash.toml", "edge_splash", "corrected", "depth_image = 'depth.exr'\nsource = 'files'\ndepth_encoding = 'metres'\n");
    scene("glass.toml", "rainy_glass", "corrected", "depth_image = 'depth.exr'\n[maps]\nsize = 16\ndroplets = 20\ntrails = 2\n");
    scene("printed_glass.toml", "rainy_glass", "as-published", "[maps]\nsize = 16\ndroplets = 20\ntrails = 2\n");
    scene("drive.toml", "windshield", "corrected", "depth_image = 'depth.exr'\nsize = [24, 16]\n[windshield]\nheight_size = [24, 16]\n");
    scene("drops.toml", "screen_drops", "corrected", "[drops]\nlargest_radius = 12\n[flow]\nwarm_up = 1\nheight_size = [24, 16]\n");
    scene("printed_drops.toml", "screen_drops", "as-published", "[drops]\ngrid = 0.1\n[noise]\nsize = 16\n");
    before = folder.names();
  }
  Outcome with(const std::string& scene, const std::string& set) const { return rainref({"hash", scene, "--set", set}); }
};

TEST_F(FilesOfScenes, EveryKindOfFileIsTheSameScene) {
  for (const char* scene : {"splash.toml", "glass.toml", "printed_glass.toml", "drive.toml", "drops.toml", "printed_drops.toml"})
    expect_colours_alike(scene);
  expect_depths_alike("splash.toml", "edge_splash.edge_step=25");
  for (const char* scene : {"glass.toml", "drive.toml"}) expect_depths_alike(scene);
}

// ---- what is seen --------------------------------------------------------------------------------------------------
// Device depth is a number without a unit.
TEST_F(FilesOfScenes, DeviceDepthsHaveNoScale) {
  put_npy(folder / "device.npy", width, height, 1, [](int x, int y, int c) { return 1 / metres(x, y, c); });
  const std::vector<std::string> device{"splash.toml", "--set", "scene.depth_encoding=device", "--set", "scene.depth_image=device.npy"};
  std::vector<std::string> scaled = device;
  scaled.insert(scaled.end(), {"--set", "scene.depth_scale=3"});
  EXPECT_EQ(hash(scaled), hash(device));
}

TEST_F(FilesOfScenes, ASplashIsSeenOnTheEdge) {
  const Outcome o = rainref({"run", "splash.toml", "-o", "out", "--set", "edge_splash.rain_drop_scale=0", "--set",
                             "edge_splash.drop_color=[1,0,0]", "--image", "none", "--capture", "all"});
  ASSERT_EQ(o.code, 0) << o.err;
  std::string edge;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out"))
    if (entry.path().filename() == "out.edge.npy") edge = contents(entry.path());
  ASSERT_GT(edge.size(), static_cast<std::size_t>(width) * height);
  const std::string mask = edge.substr(edge.size() - width * height);
  // Row 0 is the bottom: near rows 0 to 7, the edge between 7 and 8.
  EXPECT_EQ(static_cast<unsigned char>(mask[8 * width + 5]), 255);
  EXPECT_EQ(mask[2 * width + 5], 0);
  EXPECT_EQ(mask[13 * width + 5], 0);
}

TEST_F(FilesOfScenes, WithoutADepthAllIsFar) {
  put_npy(folder / "far.npy", width, height, 1, [](int, int, int) { return 1000.0f; });
  put_npy(folder / "near.npy", width, height, 1, [](int, int, int) { return 7.5f; });
  for (const std::string scene : {"drive.toml", "glass.toml"}) {
    SCOPED_TRACE(scene);
    const auto lines = [&](std::vector<std::string> sets) {
      std::vector<std::string> all{scene};
      for (const std::string& s : sets) all.insert(all.end(), {"--set", s});
      return hash(all);
    };
    const auto far = lines({"scene.depth_image="});
    // Nor does fog lie before it.
    std::vector<std::string> clear{"scene.depth_image=far.npy"};
    if (scene == "drive.toml") clear.push_back("blur.fog_density=0");
    EXPECT_EQ(far, lines(clear));
    EXPECT_NE(far, lines({}));
    // A distance for all of it is a depth like any other.
    EXPECT_EQ(lines({"scene.depth_image=", "scene.depth=7.5"}), lines({"scene.depth_image=near.npy"}));
    EXPECT_NE(lines({"scene.depth_image=", "scene.depth=7.5"}), far);
    expect_refused(scene, {"scene.depth=7.5"}, HasSubstr("scene.depth: expected none beside scene.depth_image, found 7.5"));
    expect_refused(scene, {"scene.image=", "scene.depth_image=", "scene.depth=7.5"},
                   HasSubstr("scene.depth: expected scene.image beside it, found none"));
  }
  expect_refused("printed_glass.toml", {"scene.depth=7"}, HasSubstr("scene.depth"));  // corrected has it
}
TEST_F(FilesOfScenes, WithoutADepthNothingSplashes) {
  const auto shown = [&](const std::string& set, const std::string& warning) {
    expect(rainref({"run", "splash.toml", "-o", "out", "--set", "edge_splash.rain_drop_scale=0", "--set", set}), 0, testing::_,
           HasSubstr(warning));
    return contents(folder / "out/edge_splash.0001.png");
  };
  const std::string dry = shown("edge_splash.drop_alpha=0", "");
  EXPECT_NE(shown("edge_splash.drop_alpha=1", ""), dry);
  const Image far = image_io::read((shown("scene.depth_image=", "scene.image: without scene.depth_image nothing in it has an edge"),
                                    folder / "out/edge_splash.0001.png"))
                        .image;
  put(folder / "dry.png", dry);
  EXPECT_TRUE(same(far, image_io::read(folder / "dry.png").image));
}

// A panorama is seen through the camera; of a pane it is the probe too.
TEST_F(FilesOfScenes, APanoramaIsTheSceneAndTheProbe) {
  // Brighter toward +x (u = 1/2) than toward -x.
  put_npy(folder / "round.npy", 32, 16, 3,
          [](int x, int y, int) { return (x >= 8 && x < 24 ? 4.0f : 0.25f) + 0.01f * static_cast<float>(y); });
  put_npy(folder / "grey.npy", 32, 16, 3, [](int, int, int) { return 0.5f; });
  const auto look = [&](const std::string& scene, std::vector<std::string> sets) {
    sets.insert(sets.end(), {"scene.image=", "scene.panorama=round.npy", "camera.position=[0,0,0]"});
    if (scene == "glass.toml") sets.insert(sets.end(), {"scene.depth_image=", "scene.bar_spacing=0"});
    std::vector<std::string> all{scene};
    for (const std::string& s : sets) all.insert(all.end(), {"--set", s});
    return hash(all);
  };
  for (const std::string scene : {"drops.toml", "glass.toml"}) {
    EXPECT_NE(look(scene, {"camera.target=[1,0,0]"}), look(scene, {"camera.target=[-1,0,0]"})) << scene;
    expect_refused(scene, {"scene.panorama=round.npy"}, HasSubstr("scene.panorama: expected no scene.image beside it"));
  }
  const auto probe = look("glass.toml", {"camera.target=[1,0,0]", "glass.background=probe"});
  EXPECT_NE(probe, look("glass.toml", {"camera.target=[1,0,0]"}));
  // A probe of one's own goes before, and the panorama named twice is itself.
  EXPECT_EQ(look("glass.toml", {"camera.target=[1,0,0]", "glass.background=probe", "glass.probe_image=round.npy"}), probe);
  EXPECT_NE(look("glass.toml", {"camera.target=[1,0,0]", "glass.background=probe", "glass.probe_image=grey.npy"}), probe);
}

TEST_F(FilesOfScenes, AnExrHasTheBackgroundBehindDrops) {
  expect(rainref({"run", "drops.toml", "-o", "out", "--image", "exr"}), 0, testing::_, "");
  const image_io::Picture exr = image_io::read(folder / "out/screen_drops.0001.exr");
  EXPECT_THAT(exr.channel_names, testing::IsSupersetOf({"R", "G", "B", "background.R"}));
}

// ---- what is doubted -----------------------------------------------------------------------------------------------
TEST_F(FilesOfScenes, AMapThatDoesNotTileIsAWarning) {
  put_npy(folder / "ramp.npy", 32, 32, 4, [](int x, int, int) { return static_cast<float>(x) / 32; });
  put_npy(
      folder / "codes.npy", 32, 32, 4, [](int x, int, int) { return static_cast<float>(8 * x); }, true);
  put_npy(
      folder / "white.npy", 16, 16, 4, [](int x, int y, int c) { return static_cast<float>((x * 97 + y * 57 + c * 131) * 167 % 251); },
      true);
  expect(with("splash.toml", "scene.noise_image=noise.png"), 0, testing::_,
         AllOf(HasSubstr("rainref: warning: scene.noise_image does not tile"), HasSubstr("seams")));
  for (const char* key : {"maps.raindrops_image", "maps.rivulets_image"})
    expect(with("glass.toml", fmt::format("{}=ramp.npy", key)), 0, testing::_,
           HasSubstr(fmt::format("rainref: warning: {}: ramp.npy does not tile", key)));
  const Outcome ramp = with("printed_drops.toml", "noise.image=codes.npy"), white = with("printed_drops.toml", "noise.image=white.npy");
  expect(ramp, 0, testing::_,
         AllOf(HasSubstr("rainref: warning: noise.image: codes.npy does not tile"), HasSubstr("times the one between its texels")));
  expect(white, 0, testing::Ne(ramp.out), "");
}

// ---- what is refused -----------------------------------------------------------------------------------------------
TEST_F(FilesOfScenes, WhatIsMissingOrDoesNotFitIsNamed) {
  put_npy(folder / "three.npy", 32, 32, 3, [](int x, int, int) { return static_cast<float>(x) / 32; });
  const struct {
    const char* scene;
    std::vector<std::string> sets;
    const char* says;
    int code = 2;
  } refused[]{
      {"splash.toml", {"scene.image=", "scene.depth_image="}, "scene.image: expected a file, because scene.source is \"files\""},
      {"splash.toml", {"scene.image="}, "scene.image: expected a file, because scene.source is \"files\""},
      {"splash.toml", {"scene.image=", "scene.source=street"}, "scene.depth_image: expected scene.image beside it, found none"},
      {"splash.toml",
       {"scene.depth_image=noise.png"},
       "scene.depth_image: expected 24x16 texels as scene.image has, or another size of "
       "this shape, found 8x8"},
      {"splash.toml", {"scene.layer_image=noise.png"}, "scene.layer_image: expected 24x16"},
      {"splash.toml", {"scene.depth_encoding=device"}, "scene.depth_image: expected device depths from 0 to 1, found 2 at column 0, row 0"},
      {"splash.toml", {"scene.far=30"}, "found 40 at column 0, row 8 from the bottom"},
      {"splash.toml", {"scene.near=9", "scene.far=3"}, "scene.near, scene.far: expected 0 < near < far, found 9 and 3"},
      {"splash.toml", {"scene.depth_image=nowhere.npy"}, "nowhere.npy", 4},
      {"splash.toml", {"edge_splash.bend=1"}, "edge_splash.band"},
      {"glass.toml", {"scene.image="}, "scene.depth_image: expected scene.image beside it, found none"},
      {"drive.toml", {"scene.image="}, "scene.depth_image: expected scene.image beside it, found none"},
      {"glass.toml", {"glass.background=probe"}, "glass.probe_image: expected a panorama beside scene.image, found none"},
      {"glass.toml", {"glass.drop_tile=0"}, "glass.drop_tile"},
      {"glass.toml", {"glass.rivulet_tile=0"}, "glass.rivulet_tile"},
      {"drops.toml", {"scene.image=holed.npy"}, "scene.image: 'holed.npy': NaN at x 3, y 2 (from the top)"},
      {"drops.toml", {"glass.height=0"}, "glass.height"},
      {"drops.toml", {"drops.largest_radius=0"}, "drops.largest_radius"},
      {"drops.toml", {"drops.shortest_cycle=40"}, "drops.shortest_cycle: expected at most drops.longest_cycle = 30 s, found 40"},
      {"drops.toml", {"camera.target=[0,0,0]", "camera.position=[0,0,0]"}, "camera"},
      {"drops.toml", {"drops.shre=1"}, "drops.share"},
      {"drops.toml", {"drops.grid=0.1"}, "drops.grid"},            // as-published has it
      {"printed_drops.toml", {"glass.height=1"}, "glass.height"},  // corrected has it
      {"printed_drops.toml", {"drops.grid=0"}, "drops.grid"},
  };
  for (const auto& [scene, sets, says, exit_code] : refused) expect_refused(scene, sets, HasSubstr(says), exit_code);
  for (const char* key : {"maps.raindrops_image", "maps.rivulets_image"})
    for (const char* file : {"three.npy", "depth.npy"})
      expect_refused("glass.toml", {fmt::format("{}={}", key, file)},
                     AllOf(HasSubstr(key), HasSubstr("expected four channels, with an alpha, found")));
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_refused("drops.toml", {"scene.image=pipe"}, HasSubstr("--set scene.image: cannot read 'pipe'"), 4);  // and does not wait
}

TEST_F(FilesOfScenes, DamagedNpyIsNamed) {
  for (const std::string key : {"scene.depth_image", "scene.noise_image", "scene.layer_image"}) {
    expect_refused("splash.toml", {key + "=cut.npy"}, HasSubstr(key + ": 'cut.npy'"));
    expect_refused("splash.toml", {key + "=text.npy"}, HasSubstr(key + ": 'text.npy': not an EXR, PNG, Radiance HDR or JPEG file"));
    expect_refused("splash.toml", {key + "=holed.npy"}, HasSubstr("'holed.npy': NaN at x 3, y 2 (from the top), channel 0"));
  }
}

// A picture that nothing looks at would go unnoticed, be it missing, damaged or of something else.
TEST_F(FilesOfScenes, APictureWithoutUseIsRefused) {
  expect_refused(
      "glass.toml", {"glass.normal_image=none.png"},
      HasSubstr("--set glass.normal_image: expected none where glass.shape is \"pane\", which does not use it, found 'none.png'"));
  expect_refused("glass.toml", {"glass.shape=sphere", "glass.normal_image=depth.npy"},
                 HasSubstr("glass.normal_image: expected none where glass.shape is \"sphere\""));
  expect_refused(
      "glass.toml", {"glass.probe_image=none.png"},
      HasSubstr("--set glass.probe_image: expected none where glass.background is \"grab\", which does not use it, found 'none.png'"));
  put(folder / "unused.toml", contents(folder / "glass.toml") + "[glass]\nprobe_image = 'x.png'\n");
  const std::size_t line = lines_of(contents(folder / "unused.toml")).size();
  expect_refused("unused.toml", {}, HasSubstr(fmt::format("unused.toml:{}:1: glass.probe_image: expected none", line)));
  expect_refused("glass.toml", {"glass.background=probe", "glass.probe_image=text.npy"},
                 HasSubstr("glass.probe_image: 'text.npy': not an EXR"));
}

}  // namespace
}  // namespace rainref::cli
