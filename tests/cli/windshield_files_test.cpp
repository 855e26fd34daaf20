// windshield before a picture from files.
#include "cli/picture_files.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;

class WindshieldFiles : public SceneFiles {
 protected:
  WindshieldFiles() {
    put(folder / "drive.toml",
        fmt::format("effect = 'windshield'\nvariant = 'corrected'\n[run]\nframes = 2\nsize = [{}, {}]\n[windshield]\nheight_size = [24, "
                    "16]\n[scene]\nimage = 'colour.png'\ndepth_image = 'depth.exr'\n",
                    width, height));
    before = folder.names();
  }
};

TEST_F(WindshieldFiles, EveryKindOfFileIsTheSameScene) {
  expect_colours_alike("drive.toml");
  expect_depths_alike("drive.toml");
}
TEST_F(WindshieldFiles, WithoutADepthAllIsFar) {
  put_npy(folder / "far.npy", width, height, 1, [](int, int, int) { return 1000.0f; });
  const auto with = [&](const std::string& depth) {
    return hash({"drive.toml", "--set", "blur.fog_density=0.001", "--set", "scene.depth_image=" + depth});
  };
  EXPECT_EQ(with(""), with("far.npy"));
  EXPECT_NE(with(""), with("depth.exr"));
  // Where fog hides all of it, a warning says so.
  const Outcome foggy = rainref({"hash", "drive.toml", "--set", "scene.depth_image="});
  EXPECT_EQ(foggy.code, 0);
  EXPECT_THAT(foggy.err,
              HasSubstr("warning: scene.image: without scene.depth_image it lies 1000 m away, behind the fog of blur.fog_density"));
  expect_refused("drive.toml", {"scene.image="}, HasSubstr("scene.depth_image: expected scene.image beside it, found none"));
}

}  // namespace
}  // namespace rainref::cli
