// The test card's distances and colours are those of its walls and tiles, whoever looks and with how many threads.
#include "scene/test_card.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rainref::scene {
namespace {

TEST(TestCard, RaysMeetRoadWallsAndSky) {
  const TestCard card;
  EXPECT_EQ(card.look({0, 1.5, 0}, {0, -1, 0}).distance, 1.5);
  EXPECT_EQ(card.look({1, 1.5, 0}, {1, 0, 0}).distance, 6.5);
  EXPECT_EQ(card.look({1, 1.5, 0}, {-0.6, 0.8, 0}).distance, std::numeric_limits<double>::infinity()) << "over the wall";
  EXPECT_EQ(card.look({0, 1.5, 0}, {0, 1e-300, -1}).distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(card.look({0, 1.5, 0}, {0, 1, 0}).radiance, Vector3(0.03, 0.025, 0.0375) * 0.25);
  EXPECT_EQ(card.look({0, 1.5, 0}, {0, -1, 0}).radiance, Vector3(1, 6, 11) / 64.0) << "tile 0, 0";
  EXPECT_EQ(card.look({1.2, 1.5, 0}, {0, -1, 0}).radiance, Vector3(12, 17, 5) / 64.0) << "the next one aside";
}

TEST(TestCard, PicturesAreRaysThroughTheirTexels) {
  const TestCard card;
  const Camera camera{{0.3, 1.4, 2}, {0.5, 1, -10}, {0, 1, 0}, 50};
  parallel::Executor executor(3);
  executor.shuffle_tiles(7);
  const Scenery::View view = card.view(camera, 31, 17, 100, executor), again = card.view(camera, 31, 17, 100, parallel::Executor(1));
  const Camera::Basis basis = camera.basis();
  int far = 0;
  for (int y = 0; y < 17; ++y) {
    EXPECT_EQ(std::memcmp(view.colour.row<float>(y), again.colour.row<float>(y), 31 * 4 * sizeof(float)), 0);
    for (int x = 0; x < 31; ++x) {
      const double half = camera.half_height();
      const Vector3 ray =
          basis.forward + half * 31 / 17 * ((2 * x + 1) / 31.0 - 1) * basis.right + half * ((2 * y + 1) / 17.0 - 1) * basis.up;
      const Scenery::Sight seen = card.look(camera.position, normalized(ray));
      const double depth = seen.distance / std::sqrt(dot(ray, ray));
      far += depth > 100;
      EXPECT_NEAR(view.depth.row<float>(y)[x], std::min(depth, 100.0), 1e-6 * depth) << x << " " << y;
    }
  }
  EXPECT_GT(far, 0);
  // Straight down and up, and -x in the first column.
  const Image around = card.panorama(64, 32, {0, 0.05, 0}, executor);
  EXPECT_EQ(around.row<float>(0)[0], 1 / 64.0f);
  EXPECT_LT(around.row<float>(31)[0], 0.03f * 0.27f);
  EXPECT_EQ(around.row<float>(16)[0], static_cast<float>(card.look({0, 0.05, 0}, normalized({-1, 0.05, -0.05})).radiance.x));
}

}  // namespace
}  // namespace rainref::scene
