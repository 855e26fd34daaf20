// edge_splash on files: what runs, what is doubted, what is refused.
#include "cli/picture_files.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class EdgeSplashFiles : public SceneFiles {
 protected:
  EdgeSplashFiles() {
    // A step at the seam.
    image_io::write_png(folder / "noise.png", image_of(Format::rgba8, 8, 8, [](int, int y, int) { return y == 7 ? 250.0f : 10.0f; }));
    put(folder / "files.toml", text("scene.depth_image = 'depth.exr'"));
    before = folder.names();
  }
  static std::string text(const std::string& line) {
    return "effect = 'edge_splash'\nvariant = 'corrected'\nrun.frames = 2\nscene.source = 'files'\nscene.image = "
           "'colour.png'\nscene.depth_encoding = 'metres'\n" +
           line + "\n";
  }
};

TEST_F(EdgeSplashFiles, EveryKindOfFileIsTheSameScene) {
  const auto lines = hash({"files.toml"});
  EXPECT_EQ(lines.size(), 2u * 5 + 1);
  EXPECT_NE(hash({"files.toml", "--set", "edge_splash.edge_step=50"}), lines);
  expect_colours_alike("files.toml");
  expect_depths_alike("files.toml", "edge_splash.edge_step=25");
}
// Device depth is a number without a unit.
TEST_F(EdgeSplashFiles, DeviceDepthsHaveNoScale) {
  put_npy(folder / "device.npy", width, height, 1, [](int x, int y, int c) { return 1 / metres(x, y, c); });
  const std::vector<std::string> device{"files.toml", "--set", "scene.depth_encoding=device", "--set", "scene.depth_image=device.npy"};
  std::vector<std::string> scaled = device;
  scaled.insert(scaled.end(), {"--set", "scene.depth_scale=3"});
  EXPECT_EQ(hash(scaled), hash(device));
}

TEST_F(EdgeSplashFiles, ASplashIsSeenOnTheEdge) {
  const Outcome o = rainref({"run", "files.toml", "-o", "out", "--set", "edge_splash.rain_drop_scale=0", "--set",
                             "edge_splash.drop_color=[1,0,0]", "--image", "none", "--capture", "all"});
  ASSERT_EQ(o.code, 0) << o.err;
  std::string edge;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out")) {
    if (entry.path().filename() == "out.edge.npy") edge = contents(entry.path());
  }
  ASSERT_GT(edge.size(), static_cast<std::size_t>(width) * height);
  const std::string mask = edge.substr(edge.size() - width * height);
  // Row 0 is the bottom: near rows 0 to 7, the edge between 7 and 8.
  EXPECT_EQ(static_cast<unsigned char>(mask[8 * width + 5]), 255);
  EXPECT_EQ(mask[2 * width + 5], 0);
  EXPECT_EQ(mask[13 * width + 5], 0);
}

TEST_F(EdgeSplashFiles, ANoiseMapThatDoesNotTileIsAWarning) {
  expect(rainref({"hash", "files.toml", "--set", "scene.noise_image=noise.png"}), 0, testing::_,
         AllOf(HasSubstr("rainref: warning: scene.noise_image does not tile"), HasSubstr("seams")));
}

TEST_F(EdgeSplashFiles, WhatIsMissingOrDoesNotFitIsNamed) {
  const auto with = [](std::vector<std::string> sets) {
    std::vector<std::string> all{"run", "files.toml", "-o", "new/deep"};
    for (std::string& s : sets) {
      all.push_back("--set");
      all.push_back(std::move(s));
    }
    return all;
  };
  expect_refusal(with({"scene.depth_image="}), 2, HasSubstr("scene.depth_image: expected a file, because scene.source is \"files\""));
  expect_refusal(with({"scene.source=shapes"}), 2, HasSubstr("scene.image: needs scene.source = \"files\", found \"shapes\""));
  expect_refusal(with({"scene.depth_image=noise.png"}), 2,
                 HasSubstr("scene.depth_image: expected 24x16 texels as scene.image has, found 8x8"));
  expect_refusal(with({"scene.layer_image=noise.png"}), 2, HasSubstr("scene.layer_image: expected 24x16"));
  expect_refusal(with({"scene.depth_encoding=device"}), 2,
                 AllOf(HasSubstr("scene.depth_image: expected device depths from 0 to 1, found 2 at column 0, row 0")));
  expect_refusal(with({"scene.far=30"}), 2, HasSubstr("found 40 at column 0, row 8 from the bottom"));
  expect_refusal(with({"scene.near=9", "scene.far=3"}), 2, HasSubstr("scene.near, scene.far: expected 0 < near < far, found 9 and 3"));
  expect_refusal(with({"scene.depth_image=nowhere.npy"}), 4, HasSubstr("nowhere.npy"));
  expect_refusal(with({"edge_splash.bend=1"}), 2, HasSubstr("edge_splash.band"));
}

TEST_F(EdgeSplashFiles, DamagedNpyIsNamed) {
  put(folder / "text.npy", "not an array");
  for (const char* key : {"scene.depth_image", "scene.noise_image", "scene.layer_image"}) {
    expect_refused("files.toml", {fmt::format("{}=cut.npy", key)},
                   AllOf(HasSubstr(fmt::format("{}: 'cut.npy'", key)), HasSubstr("cut.npy")));
    expect_refused("files.toml", {fmt::format("{}=text.npy", key)},
                   HasSubstr(fmt::format("{}: 'text.npy': not an EXR, PNG, Radiance HDR or JPEG file", key)));
    expect_refused("files.toml", {fmt::format("{}=holed.npy", key)}, HasSubstr("'holed.npy': NaN at x 3, y 2 (from the top), channel 0"));
  }
}

}  // namespace
}  // namespace rainref::cli
