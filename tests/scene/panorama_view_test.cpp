// A camera's view into a panorama.
#include "scene/panorama_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/images.h"
#include "math/simd_target.h"
#include "rainref/error.h"

namespace rainref::scene {
namespace {

const double pi = std::acos(-1.0);

/// Every texel says its own direction: (d + 1) / 2.
Image directions(int width, int height) {
  return make_image(Format::rgba32f, width, height, [=](int x, int y, int k) {
    const double azimuth = 2 * pi * ((x + 0.5) / width - 0.5), rise = pi * ((y + 0.5) / height - 0.5);
    const double d[4] = {std::cos(rise) * std::cos(azimuth), std::sin(rise), std::cos(rise) * std::sin(azimuth), 0};
    return static_cast<float>(0.5 + 0.5 * d[k]);
  });
}
void expect_directions(const Image& view, const Camera& camera, double tolerance) {
  const Camera::Basis b = camera.basis();
  const double half = camera.half_height();
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      const Vector3 way = glm::normalize(b.forward + half * ((2 * x + 1.0) - view.width()) / view.height() * b.right +
                                         half * ((2 * y + 1.0) / view.height() - 1) * b.up);
      const float* seen = view.row<float>(y) + 4 * x;
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(2 * seen[k] - 1, way[k], tolerance) << x << "," << y << " channel " << k;
      ASSERT_EQ(seen[3], 1);
    }
  }
}

// Between texels h apart a bilinear lookup of a function of curvature 1 is off by h^2 / 8 along each side; beside a pole too,
// for no camera here looks into its last texel.
TEST(PanoramaView, ShowsWhatLiesInEachPixelsDirection) {
  const int columns = 512, rows = 256;
  const Image panorama = directions(columns, rows);
  const double h = pi / rows, tolerance = 2 * h * h / 8 * 1.5 + 1e-6;
  const parallel::Executor executor(2);
  for (const Vector3& target :
       {Vector3(1, 0, 0), Vector3(-1, 0.2, 0.001), Vector3(0.1, 0, 1), Vector3(0.3, -0.8, -1), Vector3(-0.2, 1, 0.1)}) {
    const Camera camera{{0, 0, 0}, target, {0, 1, 0}, 10};
    expect_directions(panorama_view(panorama, camera, 48, 27, executor), camera, tolerance);
  }
  // Far away: the eye's place does not count.
  const Camera here{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 40}, there{{7, 8, 9}, {8, 8, 9}, {0, 1, 0}, 40};
  const Image a = panorama_view(panorama, here, 16, 9, executor), b = panorama_view(panorama, there, 16, 9, executor);
  EXPECT_TRUE(same(a, b));
}

// A pixel that covers many texels shows their mean, not one of them: of stripes a grey.
TEST(PanoramaView, CoarseViewsAreFiltered) {
  const Image stripes = make_image(Format::rgba32f, 1024, 512, [](int x, int, int) { return static_cast<float>(x % 2); });
  const Image view = panorama_view(stripes, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 60}, 32, 18, parallel::Executor(1));
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 32; ++x) EXPECT_NEAR(view.row<float>(y)[4 * x], 0.5, 1e-6);
  }
}

TEST(PanoramaView, ThreadsAndTargetsGiveTheSameBits) {
  const Image panorama = directions(64, 32);
  const Camera camera{{0, 0, 0}, {0.3, 0.1, -1}, {0, 1, 0}, 70};
  const Image one = panorama_view(panorama, camera, 33, 21, parallel::Executor(1));
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    for (const int threads : {2, 3, 8})
      ASSERT_TRUE(same(panorama_view(panorama, camera, 33, 21, parallel::Executor(threads)), one)) << target << " " << threads;
  }
  select_simd_target("");
}

TEST(PanoramaView, OtherChannelsAreRefused) {
  EXPECT_THROW(panorama_view(Image(Format::r32f, 4, 2), {}, 4, 4, parallel::Executor(1)), Error);
}

}  // namespace
}  // namespace rainref::scene
