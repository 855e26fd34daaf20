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
  EXPECT_EQ(hash({"drive.toml", "--set", "scene.depth_image="}), hash({"drive.toml", "--set", "scene.depth_image=far.npy"}));
  expect_refused("drive.toml", {"scene.image="}, HasSubstr("scene.depth_image: expected scene.image beside it, found none"));
}

}  // namespace
}  // namespace rainref::cli
