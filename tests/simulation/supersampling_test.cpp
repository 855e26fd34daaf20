// Pictures of which the passes run at a multiple: what the mean weighs, and that nothing else changes.
#include "simulation/light_mean.h"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "image/colour.h"
#include "image/images.h"
#include "rainref/simulation.h"
#include "simulation/small_scenes.h"

namespace rainref::simulation {
namespace {

using testing::HasSubstr;

const parallel::Executor& executor() {
  static const parallel::Executor two(2);
  return two;
}
Image filled(int width, int height, int code) {
  return make_image(Format::rgba8, width, height, [=](int, int, int) { return static_cast<std::uint8_t>(code); });
}
int red(const Image& image, int x, int y) { return image.row<Unorm8>(y)[4 * x].code; }
int nearest_code(double light) { return static_cast<int>(255 * encode_srgb(light) + 0.5); }

TEST(Supersampling, ALevelPictureStaysAsItIs) {
  for (const int n : {2, 3, 4})
    for (int code = 0; code < 256; ++code) {
      const Image mean = tent_mean(filled(3 * n, 2 * n, code), n, executor());
      ASSERT_EQ(mean.width(), 3);
      ASSERT_EQ(mean.height(), 2);
      EXPECT_EQ(red(mean, 1, 1), code) << n;
      EXPECT_EQ(mean.row<Unorm8>(0)[3].code, 255) << "alpha";
    }
}

// One white sample on black: a pixel takes of it the product of two tents. The centre of sample (4, 4) of 2 x 2 lies 1/4 of a pixel left
// of and below that of pixel (2, 2), so 3/4 from those of its neighbours there: 3/8 and 1/8 of the light along each axis.
TEST(Supersampling, OneSampleIsWeighedByATent) {
  Image one = filled(10, 10, 0);
  std::memset(one.row<Unorm8>(4) + 4 * 4, 255, 4);
  const Image mean = tent_mean(one, 2, executor());
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) {
      const double along_x = x == 2 ? 3 : x == 1 ? 1 : 0, along_y = y == 2 ? 3 : y == 1 ? 1 : 0;
      EXPECT_EQ(red(mean, x, y), nearest_code(along_x * along_y / 64)) << x << " " << y;
    }
}

// 3 x 3: weights 1 2 3 2 1 over 9; 4 x 4: 1 3 5 7 7 5 3 1 over 32.
TEST(Supersampling, WeightsOfMoreSamples) {
  const auto shares = [](int n, int sample) {
    Image line = filled(5 * n, n, 0);
    for (int y = 0; y < n; ++y) std::memset(line.row<Unorm8>(y) + 4 * sample, 255, 4);
    const Image mean = tent_mean(line, n, executor());
    return std::vector<int>{red(mean, 1, 0), red(mean, 2, 0), red(mean, 3, 0)};
  };
  const auto codes = [](std::vector<double> light) {
    std::vector<int> out;
    for (const double l : light) out.push_back(nearest_code(l));
    return out;
  };
  EXPECT_EQ(shares(3, 7), codes({0, 3 / 9.0, 0}));
  EXPECT_EQ(shares(3, 8), codes({0, 2 / 9.0, 1 / 9.0}));
  EXPECT_EQ(shares(4, 8), codes({3 / 32.0, 5 / 32.0, 0}));
  EXPECT_EQ(shares(4, 9), codes({1 / 32.0, 7 / 32.0, 0}));
}

TEST(Supersampling, BeyondAnEdgeItsSamplesRepeat) {
  Image left = filled(8, 8, 0);
  for (int y = 0; y < 8; ++y) std::memset(left.row<Unorm8>(y), 255, 4);
  const Image mean = tent_mean(left, 2, executor());
  EXPECT_EQ(red(mean, 0, 1), nearest_code(0.5)) << "1/8 beyond the edge and 3/8 at it";
  EXPECT_EQ(red(mean, 1, 1), 0) << "its tent ends before";
}

TEST(Supersampling, SameBitsForAnyThreads) {
  const Image noise = make_image(Format::rgba8, 2 * 37, 2 * 29, [](int x, int y, int c) {
    return static_cast<std::uint8_t>((static_cast<unsigned>(4 * x + c) * 2654435761u + static_cast<unsigned>(y) * 40503u) >> 13);
  });
  const Image expected = tent_mean(noise, 2, parallel::Executor(1));
  for (const int threads : {2, 3, 8}) {
    parallel::Executor several(threads);
    several.shuffle_tiles(7);
    EXPECT_TRUE(same(tent_mean(noise, 2, several), expected)) << threads;
  }
}

TEST(Supersampling, APictureIsTheMeanOfThatOfThePasses) {
  for (const auto* effect : {"screen_drops", "rainy_glass", "windshield", "edge_splash"}) {
    Simulation twice(small(effect, "corrected", {"run.supersample=2"}), executor());
    Simulation large(small(effect, "corrected", {"run.size=[66, 42]"}), executor());
    for (int frame = 0; frame < 2; ++frame) {
      twice.next_frame();
      large.next_frame();
    }
    EXPECT_EQ(twice.picture().width(), 33) << effect;
    EXPECT_EQ(twice.picture().height(), 21) << effect;
    EXPECT_TRUE(same(twice.picture(), tent_mean(large.picture(), 2, executor()))) << effect;
  }
}

TEST(Supersampling, ATooLargeSizeIsRefused) {
  EXPECT_THAT(error_of([] {
                Simulation(small("edge_splash", "corrected", {"run.size=[40000, 2]", "run.supersample=2"}), executor());
              }),
              testing::AllOf(testing::StartsWith("2 "),
                             HasSubstr("run.supersample: expected at most 65536 texels a side of run.size times it, found 80000")));
}

}  // namespace
}  // namespace rainref::simulation
