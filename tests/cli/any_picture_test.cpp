// A picture of any size behind the glass: it is scaled and cropped, so that the scene is that of a picture of the size which the passes
// take.
#include "cli/picture_files.h"
#include "image/colour.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class AnyPicture : public SceneFiles, public testing::WithParamInterface<const char*> {
 protected:
  AnyPicture() {
    const auto scene = [&](const char* name, const std::string& effect, const char* variant, const std::string& rest) {
      put(folder / name, fmt::format("effect = '{}'\nvariant = '{}'\n[run]\nframes = 2\nsize = [{}, {}]\n[scene]\nimage = 'colour.npy'\n{}",
                                     effect, variant, width, height, rest));
    };
    const std::string depth = "depth_image = 'depth.npy'\n", metres = depth + "depth_encoding = 'metres'\n", maps = "[maps]\nsize = 16\n",
                      car = "size = [24, 16]\n[windshield]\nheight_size = [24, 16]\n";
    scene("edge_splash", "edge_splash", "corrected", metres + "[edge_splash]\nrain_drop_scale = 0\n");
    scene("edge_splash_published", "edge_splash", "as-published", metres);
    scene("screen_drops", "screen_drops", "corrected", "[drops]\nlargest_radius = 12\n[flow]\non = false\n");
    scene("screen_drops_published", "screen_drops", "as-published", "[drops]\ngrid = 0.1\n[noise]\nsize = 16\n");
    scene("rainy_glass", "rainy_glass", "corrected", depth + maps);
    scene("rainy_glass_published", "rainy_glass", "as-published", maps);
    scene("windshield", "windshield", "corrected", depth + car);
    scene("windshield_published", "windshield", "as-published", depth + car);
    before = folder.names();
  }
  static bool has_depth(const std::string& scene) { return scene.find("screen") == scene.npos && scene != "rainy_glass_published"; }
  static std::vector<std::string> with(const std::string& scene, const std::string& colour, const std::string& depth) {
    std::vector<std::string> all{scene, "--set", "scene.image=" + colour};
    if (has_depth(scene)) all.insert(all.end(), {"--set", "scene.depth_image=" + depth});
    return all;
  }
};

// The mean of equal texels is each of them, and what is cut does not count.
TEST_P(AnyPicture, OfTexelsRepeatedIsTheSmallOne) {
  const std::string scene = GetParam();
  const auto lines = hash({scene});
  for (const int by : {2, 3, 7}) {
    const auto column = [&](int x) { return std::min(std::max(x, 0) / by, width - 1); };
    put_npy(
        folder / "large.npy", by * width, by * height, 3, [&](int x, int y, int c) { return code(x / by, y / by, c); }, true);
    put_npy(folder / "large_depth.npy", by * width, by * height, 1, [&](int x, int y, int c) { return metres(x / by, y / by, c); });
    EXPECT_EQ(hash(with(scene, "large.npy", "large_depth.npy")), lines) << by;
    EXPECT_EQ(hash(with(scene, "large.npy", "depth.npy")), lines) << by;
    EXPECT_EQ(hash(with(scene, "colour.npy", "large_depth.npy")), lines) << by;
    // Wider, with white at both sides.
    put_npy(
        folder / "wide.npy", by * width + 17, by * height, 3,
        [&](int x, int y, int c) { return x < 8 || x >= by * width + 8 ? 255.0f : code((x - 8) / by, y / by, c); }, true);
    put_npy(folder / "wide_depth.npy", by * width + 17, by * height, 1,
            [&](int x, int y, int c) { return metres(column(x - 8), y / by, c); });
    EXPECT_EQ(hash(with(scene, "wide.npy", "wide_depth.npy")), lines) << by;
    // Higher.
    put_npy(
        folder / "high.npy", by * width, by * height + 10, 3,
        [&](int x, int y, int c) { return y < 5 || y >= by * height + 5 ? 255.0f : code(x / by, (y - 5) / by, c); }, true);
    put_npy(folder / "high_depth.npy", by * width, by * height + 10, 1,
            [&](int x, int y, int c) { return metres(x / by, std::min(std::max(y - 5, 0) / by, height - 1), c); });
    EXPECT_EQ(hash(with(scene, "high.npy", "high_depth.npy")), lines) << by;
  }
}

// A size that nobody asked the picture for, and twice that of the passes.
TEST_P(AnyPicture, IsTakenAtAnySizeOfTheRun) {
  const std::string scene = GetParam();
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{"run.size=[31, 9]"}, {"run.supersample=2"}, {"run.size=[7, 40]", "run.supersample=3"}}) {
    std::vector<std::string> words{"run", scene, "-o", "out"};
    for (const std::string& s : set) words.insert(words.end(), {"--set", s});
    expect(rainref(words), 0);
  }
}

/// A photograph of 4:3, ten times as fine as the run: hills of colour, and a fine grid that only a mean takes away.
float photograph(int x, int y, int c) {
  const double hill = 0.5 + 0.3 * std::sin(0.02 * x + c) * std::cos(0.03 * y - c), grid = (x / 2 + y / 2) % 2 == 0 ? 0.2 : -0.2;
  return static_cast<float>(std::floor(255 * (hill + grid)));
}
// Without a drop before it, the picture is the photograph in its middle, scaled down in linear light: here by definition.
TEST_P(AnyPicture, IsSeenBehindDryGlass) {
  const std::string scene = GetParam();
  put_npy(folder / "photo.npy", 320, 240, 3, photograph, true);
  std::vector<std::string> words{"run", scene, "-o", "out", "--frames", "1"};
  for (const char* s : {"scene.image=photo.npy", "run.size=[32, 18]", "display.exposure=0"}) words.insert(words.end(), {"--set", s});
  const auto set = [&](const std::vector<std::string>& more) {
    for (const std::string& s : more) words.insert(words.end(), {"--set", s});
  };
  if (has_depth(scene)) set({"scene.depth_image="});
  if (scene == "screen_drops") set({"drops.share=0", "scene.margin=1", "background.defocus=0"});
  if (scene == "screen_drops_published") set({"drops.threshold=2", "background.level=0"});
  if (scene.starts_with("rainy")) set({"maps.droplets=0", "maps.trails=0"});
  if (scene.starts_with("windshield")) set({"scene.size=[32, 18]", "scene.margin=1", "composite.wetness=0", "composite.glint_strength=0"});
  if (scene == "windshield") set({"rain.rate=0", "composite.water_ior=1"});  // what bends no ray mirrors nothing
  if (scene == "windshield_published") set({"windshield.spawn_rate=0"});
  expect(rainref(words), 0);
  const std::string effect = scene.substr(0, scene.find("_published"));
  const Image seen = image_io::read(folder / fmt::format("out/{}.0000.png", effect)).image;
  ASSERT_EQ(seen.width(), 32);
  ASSERT_EQ(seen.height(), 18);
  double sum = 0;
  int worst = 0;
  for (int y = 0; y < 18; ++y) {
    for (int i = 0; i < 96; ++i) {
      double light = 0;
      for (int k = 0; k < 10 * 10; ++k)
        light += decode_srgb(photograph(10 * (i / 3) + k % 10, 30 + 10 * y + k / 10, i % 3) / 255.0) / (10 * 10);
      const int off = std::abs(static_cast<int>(seen.row<std::uint8_t>(y)[i / 3 * 4 + i % 3]) -
                               static_cast<int>(std::lround(255 * encode_srgb(light))));
      sum += off;
      worst = std::max(worst, off);
    }
  }
  EXPECT_LT(sum / (18 * 96), 1.5) << worst;  // halves and codes: a code
}
INSTANTIATE_TEST_SUITE_P(Scenes, AnyPicture,
                         testing::Values("edge_splash", "edge_splash_published", "screen_drops", "screen_drops_published", "rainy_glass",
                                         "rainy_glass_published", "windshield", "windshield_published"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace rainref::cli
