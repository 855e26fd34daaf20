// What of the street is kept for other runs is what was rendered.

#include <gtest/gtest.h>

#include "base/temporary_folder.h"
#include "cache/kept_images.h"
#include "image/images.h"
#include "night_street/night_street.h"

namespace rainref::night_street {
namespace {

class KeptStreet : public testing::Test {
 protected:
  ~KeptStreet() override { cache::keep_in({}); }
  std::size_t files() const {
    return std::filesystem::exists(folder / "kept")
               ? static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder / "kept"), {}))
               : 0;
  }
  TemporaryFolder folder;
  parallel::Executor executor{2};
};

TEST_F(KeptStreet, APanoramaAndAViewAreWhatWasRendered) {
  const auto panorama = [&](std::uint64_t seed, double height) { return Street({seed}).panorama(32, 16, {0, height, 0}, executor); };
  const auto view = [&](Parts parts, double far, double fov) {
    scene::Camera camera;
    camera.position = {1, 1.5, 3};
    camera.vertical_fov_deg = fov;
    return Street({7, true}).view(camera, 24, 12, far, executor, parts);
  };
  const Image around = panorama(3, 0.05), higher = panorama(3, 2), other = panorama(4, 0.05);
  const Street::View seen = view(Parts::nine, 500, 60), near = view(Parts::nine, 20, 60), narrow = view(Parts::nine, 500, 30);
  cache::keep_in(folder / "kept");
  for (int k = 0; k < 2; ++k) {
    EXPECT_TRUE(same(panorama(3, 0.05), around));
    EXPECT_TRUE(same(panorama(3, 2), higher));
    EXPECT_TRUE(same(panorama(4, 0.05), other));
    const std::pair<const Street::View*, Street::View> views[] = {
        {&seen, view(Parts::nine, 500, 60)}, {&near, view(Parts::nine, 20, 60)}, {&narrow, view(Parts::nine, 500, 30)}};
    for (const auto& [expected, found] : views) {
      EXPECT_TRUE(same(found.colour, expected->colour));
      EXPECT_TRUE(same(found.depth, expected->depth));
    }
    EXPECT_EQ(files(), 6u);
  }
  // Those that pass are not kept.
  view(Parts::three, 500, 60);
  EXPECT_EQ(files(), 6u);
}

}  // namespace
}  // namespace rainref::night_street
