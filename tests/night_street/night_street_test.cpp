// The street's promises: sound numbers, geometry that agrees with arithmetic done by hand. Its bits are in tests/golden.
#include "night_street/night_street.h"

#include <cmath>

#include <gtest/gtest.h>

#include "rainref/error.h"

namespace rainref::night_street {
namespace {

/// A driver's look down the street.
scene::Camera driver() { return {{1.9, 1.35, 0}, {1.2, 1.75, -20}, {0, 1, 0}, 50}; }
constexpr scene::Vector3 puddle_eye{0, 0.05, 0};

const Street& street() {
  static const Street one({1});
  return one;
}

const Image& small_panorama() {
  static const Image image = street().panorama(256, 128, puddle_eye, parallel::Executor(2));
  return image;
}

TEST(NightStreet, AClearLaneHasNoCarAndNothingElseChanges) {
  const Street clear({1, true});
  const auto free_way = [](const Street& s, double x) { return s.look({x, 0.6, 190}, {0, 0, -1}).distance; };
  EXPECT_LT(free_way(street(), 1.95), 130);
  EXPECT_GT(free_way(clear, 1.95), 390);
  for (const double x : {-1.95, -6.0, 3.5, 6.0}) EXPECT_EQ(free_way(clear, x), free_way(street(), x)) << x;
}

TEST(NightStreet, IsAnotherStreetForAnotherSeed) {
  const parallel::Executor executor(2);
  const Image a = street().panorama(64, 32, puddle_eye, executor), b = Street({2}).panorama(64, 32, puddle_eye, executor);
  int different = 0;
  for (int y = 16; y < 32; ++y) {  // above the horizon, where the houses are
    for (int x = 0; x < 64; ++x) {
      const float p = a.row<float>(y)[4 * x], q = b.row<float>(y)[4 * x];
      different += std::fabs(p - q) > 0.1f * (p + q);
    }
  }
  EXPECT_GT(different, 64 * 16 / 10);
}

TEST(NightStreet, RadianceIsFiniteAndNotNegativeAndAlphaIsOne) {
  const Street::View view = street().view(driver(), 160, 90, 400, parallel::Executor(2));
  for (const Image* image : {&small_panorama(), &view.colour}) {
    for (int y = 0; y < image->height(); ++y) {
      for (int x = 0; x < image->width(); ++x) {
        const float* texel = image->row<float>(y) + 4 * x;
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(texel[c]) && texel[c] >= 0) << x << ' ' << y << ' ' << texel[c];
        ASSERT_EQ(texel[3], 1);
      }
    }
  }
}

TEST(NightStreet, DepthOfTheRoadIsThatOfThePlane) {
  // Down at the road before the camera, which is empty for 6 m: depth follows from the height alone.
  const double height = 1.4;
  const scene::Camera camera{{0.3, height, 0}, {0.3, 0, -2.5}, {0, 1, 0}, 50};
  const int width = 64, rows = 48;
  int judged = 0;
  const Street::View view = street().view(camera, width, rows, 100, parallel::Executor(2));
  const scene::Camera::Basis basis = camera.basis();
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width; ++x) {
      const double across = (2 * (x + 0.5) / width - 1) * camera.half_height() * width / rows;
      const double upward = (2 * (y + 0.5) / rows - 1) * camera.half_height();
      const scene::Vector3 ray = basis.forward + across * basis.right + upward * basis.up;
      const double expected = height / -ray[1];  // the ray advances 1 m along the axis for each unit of its parameter
      if (std::fabs(camera.position[0] + expected * ray[0]) > 4.4) continue;  // the kerb and what lies behind it
      if (expected * ray[2] < -6) continue;                                   // a car may stand there
      ++judged;
      ASSERT_NEAR(view.depth.row<float>(y)[x], expected, 1e-6 * expected) << x << ' ' << y;
    }
  }
  EXPECT_GT(judged, width * rows / 2);
}

TEST(NightStreet, DepthOfTheSkyIsFar) {
  const scene::Camera camera{{0, 1, 0}, {0, 101, 0}, {0, 0, 1}, 10};
  const Street::View view = street().view(camera, 16, 16, 123, parallel::Executor(1));
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) ASSERT_EQ(view.depth.row<float>(y)[x], 123);
  }
}

TEST(NightStreet, RefusesAFarDistanceThatIsNone) {
  const parallel::Executor executor(1);
  EXPECT_THROW(street().view(driver(), 4, 4, 0, executor), Error);
  EXPECT_THROW(street().view(driver(), 4, 4, std::nan(""), executor), Error);
}

/// Mean step in brightness between two columns of a panorama; the square root ranks brightness as an eye does.
double column_step(const Image& image, int a, int b) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    sum += std::fabs(std::sqrt(image.row<float>(y)[4 * a + 1]) - std::sqrt(image.row<float>(y)[4 * b + 1]));
  }
  return sum / image.height();
}

TEST(NightStreet, PanoramaHasNoSeam) {
  const Image& image = small_panorama();
  const int width = image.width();
  double nearby = 0;
  for (int i = 0; i < 8; ++i) nearby += (column_step(image, i, i + 1) + column_step(image, width - 2 - i, width - 1 - i)) / 16;
  EXPECT_LT(column_step(image, width - 1, 0), 2 * nearby);
}

TEST(NightStreet, PanoramaPolesAreTheirDirections) {
  // All texels of the top row look almost straight up into the sky: one colour within the clouds of a degree.
  const Image& image = small_panorama();
  const float first = image.row<float>(image.height() - 1)[2];
  for (int x = 0; x < image.width(); ++x) EXPECT_NEAR(image.row<float>(image.height() - 1)[4 * x + 2], first, 0.05f * first);
}

TEST(NightStreet, PanoramaAndViewAgree) {
  // One texel of the panorama and a view of one texel in its direction. A texel is a mean over its area, so it may
  // differ from the radiance at its centre by as much as its neighbourhood varies; edges are left out. The ground is
  // left out too: its glitter has finer grain than any texel.
  const Image& image = small_panorama();
  const parallel::Executor executor(1);
  constexpr double pi = 3.14159265358979;
  int judged = 0;
  for (int y = image.height() / 2 + 2; y < image.height() - 1; y += 3) {
    for (int x = 1; x < image.width() - 1; x += 5) {
      float low = 1e9f, high = 0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const float green = image.row<float>(y + j)[4 * (x + i) + 1];
          low = std::min(low, green);
          high = std::max(high, green);
        }
      }
      if (high > 1.08f * low) continue;
      const double azimuth = 2 * pi * ((x + 0.5) / image.width() - 0.5), elevation = pi * ((y + 0.5) / image.height() - 0.5);
      const scene::Vector3 direction{std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
      const scene::Camera camera{puddle_eye, puddle_eye + direction, {0, 1, 0}, 10};
      const Street::View view = street().view(camera, 1, 1, 400, executor);
      for (int c = 0; c < 3; ++c) {
        const float from_panorama = image.row<float>(y)[4 * x + c];
        EXPECT_NEAR(view.colour.row<float>(0)[c], from_panorama, 0.08f * from_panorama) << x << ' ' << y << " channel " << c;
      }
      ++judged;
    }
  }
  EXPECT_GT(judged, 200);
}

TEST(NightStreet, LampsShineWhereTheyAreListed) {
  const parallel::Executor executor(1);
  const scene::Vector3 eye{0, 3, 0};
  int seen = 0, hidden = 0;
  for (const Lamp& lamp : street().lamps()) {
    const scene::Vector3 towards = lamp.position - eye;
    const double distance = std::sqrt(glm::dot(towards, towards));
    if (lamp.position[1] < 7 || distance > 60) continue;  // street lamps, before the haze dims them
    const Street::View view = street().view({eye, lamp.position, {0, 1, 0}, 1}, 1, 1, 400, executor);
    const float depth = view.depth.row<float>(0)[0];
    if (depth < distance - lamp.radius - 1e-3) {  // a sign, a post or another lamp stands before it
      ++hidden;
      continue;
    }
    EXPECT_NEAR(depth, distance - lamp.radius, 1e-3);  // the nearest point of the sphere
    EXPECT_GT(view.colour.row<float>(0)[0], 0.5f * lamp.radiance[0]);
    ++seen;
  }
  EXPECT_GE(seen, 6);
  EXPECT_LE(hidden, 3);
}

TEST(NightStreet, NothingOutshinesTheLamps) {
  // Whatever is brighter than any neon tube or room lies within a texel of a listed lamp or its closest halo.
  const Image& image = small_panorama();
  constexpr double pi = 3.14159265358979;
  for (int y = image.height() / 2; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.row<float>(y)[4 * x] < 16) continue;
      const double azimuth = 2 * pi * ((x + 0.5) / image.width() - 0.5), elevation = pi * ((y + 0.5) / image.height() - 0.5);
      const scene::Vector3 direction{std::cos(elevation) * std::cos(azimuth), std::sin(elevation), std::cos(elevation) * std::sin(azimuth)};
      double best = -1;
      for (const Lamp& lamp : street().lamps()) best = std::max(best, glm::dot(direction, scene::normalized(lamp.position - puddle_eye)));
      EXPECT_GT(best, std::cos(2.5 * 2 * pi / image.width())) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace rainref::night_street
