// rainy_glass on files: what runs, what is doubted, what is refused.
#include "cli/picture_files.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RainyGlassFiles : public SceneFiles {
 protected:
  RainyGlassFiles() {
    put(folder / "glass.toml", text("corrected", "depth_image = 'depth.exr'\n"));
    put(folder / "printed.toml", text("as-published", ""));
    before = folder.names();
  }
  static std::string text(const std::string& variant, const std::string& depth) {
    return fmt::format(
        "effect = 'rainy_glass'\nvariant = '{}'\n[run]\nframes = 2\nsize = [{}, {}]\n[maps]\nsize = 16\ndroplets = 20\ntrails = "
        "2\n[scene]\nimage = 'colour.png'\n{}",
        variant, width, height, depth);
  }
};

TEST_F(RainyGlassFiles, EveryKindOfFileIsTheSameScene) {
  expect_colours_alike("glass.toml");
  expect_depths_alike("glass.toml");
  expect_colours_alike("printed.toml");
}

TEST_F(RainyGlassFiles, APanoramaIsTheSceneAndTheProbe) {
  put_npy(folder / "round.npy", 32, 16, 3, [](int x, int y, int) { return static_cast<float>((7 * x + 5 * y) % 17) / 4; });
  put_npy(folder / "grey.npy", 32, 16, 3, [](int, int, int) { return 0.5f; });
  const auto look = [&](std::vector<std::string> sets) {
    std::vector<std::string> all{"glass.toml",          "--set", "scene.image=",           "--set", "scene.depth_image=", "--set",
                                 "scene.bar_spacing=0", "--set", "camera.position=[0,0,0]"};
    for (const std::string& s : sets) all.insert(all.end(), {"--set", s});
    return hash(all);
  };
  const auto grab = look({"scene.panorama=round.npy", "camera.target=[1,0,0]"});
  EXPECT_NE(grab, look({"scene.panorama=round.npy", "camera.target=[-1,0,0]"}));
  const auto probe = look({"scene.panorama=round.npy", "camera.target=[1,0,0]", "glass.background=probe"});
  EXPECT_NE(probe, grab);
  // A probe of one's own goes before, and the panorama named twice is itself.
  EXPECT_EQ(look({"scene.panorama=round.npy", "camera.target=[1,0,0]", "glass.background=probe", "glass.probe_image=round.npy"}), probe);
  EXPECT_NE(look({"scene.panorama=round.npy", "camera.target=[1,0,0]", "glass.background=probe", "glass.probe_image=grey.npy"}), probe);
  expect_refused("glass.toml", {"scene.panorama=round.npy"}, HasSubstr("scene.panorama: expected no scene.image beside it"));
}

TEST_F(RainyGlassFiles, MapsWithoutAlphaAreRefusedAndSeamsDoubted) {
  put_npy(folder / "ramp.npy", 32, 32, 4, [](int x, int, int) { return static_cast<float>(x) / 32; });
  put_npy(folder / "three.npy", 32, 32, 3, [](int x, int, int) { return static_cast<float>(x) / 32; });
  for (const char* key : {"maps.raindrops_image", "maps.rivulets_image"}) {
    expect(rainref({"hash", "glass.toml", "--set", fmt::format("{}=ramp.npy", key)}), 0, testing::_,
           HasSubstr(fmt::format("rainref: warning: {}: ramp.npy does not tile", key)));
    for (const char* file : {"three.npy", "depth.npy"}) {
      expect_refused("glass.toml", {fmt::format("{}={}", key, file)},
                     AllOf(HasSubstr(key), HasSubstr("expected four channels, with an alpha, found")));
    }
  }
}

// A picture that nothing looks at would go unnoticed, be it missing, damaged or of something else.
TEST_F(RainyGlassFiles, APictureWithoutUseIsRefused) {
  expect_refused(
      "glass.toml", {"glass.normal_image=none.png"},
      HasSubstr("--set glass.normal_image: expected none where glass.shape is \"pane\", which does not use it, found 'none.png'"));
  expect_refused("glass.toml", {"glass.shape=sphere", "glass.normal_image=depth.npy"},
                 HasSubstr("glass.normal_image: expected none where glass.shape is \"sphere\""));
  expect_refused(
      "glass.toml", {"glass.probe_image=none.png"},
      HasSubstr("--set glass.probe_image: expected none where glass.background is \"grab\", which does not use it, found 'none.png'"));
  put(folder / "unused.toml", contents(folder / "glass.toml") + "[glass]\nprobe_image = 'x.png'\n");
  const int line = static_cast<int>(lines_of(contents(folder / "unused.toml")).size());
  expect_refused("unused.toml", {}, HasSubstr(fmt::format("unused.toml:{}:1: glass.probe_image: expected none", line)));
  put(folder / "broken.png", "no picture");
  expect_refused("glass.toml", {"glass.background=probe", "glass.probe_image=broken.png"},
                 HasSubstr("glass.probe_image: 'broken.png': not an EXR"));
}

TEST_F(RainyGlassFiles, WhatIsMissingIsNamed) {
  expect_refused("glass.toml", {"scene.depth_image="}, HasSubstr("scene.depth_image: expected a depth beside scene.image, found none"));
  expect_refused("glass.toml", {"scene.image="}, HasSubstr("scene.depth_image: expected scene.image beside it, found none"));
  expect_refused("glass.toml", {"glass.background=probe"},
                 HasSubstr("glass.probe_image: expected a panorama beside scene.image, found none"));
  expect_refused("glass.toml", {"glass.drop_tile=0"}, HasSubstr("glass.drop_tile"));
  expect_refused("glass.toml", {"glass.rivulet_tile=0"}, HasSubstr("glass.rivulet_tile"));
}

}  // namespace
}  // namespace rainref::cli
