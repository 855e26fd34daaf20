// Pictures in the place of another size, against what follows from the definition.
#include "image/fit.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "image/images.h"

namespace rainref {
namespace {

float noise(int x, int y, int c) {
  const auto word = static_cast<std::uint32_t>(x * 73856093 ^ y * 19349663 ^ c * 83492791) * 2654435761u;
  return static_cast<float>(word >> 8) * 0x1p-24f;
}
Image noise_of(int width, int height) { return make_image(Format::rgba32f, width, height, noise); }
ReadRow rows_of(const Image& picture) {
  return [&picture](int y, float* texels) { std::copy_n(picture.row<float>(y), 4 * picture.width(), texels); };
}
Image fitted_to(const Image& picture, Size size) {
  return fitted(rows_of(picture), size_of(picture), centred_part(size_of(picture), size), size);
}
double at(const Image& picture, int x, int y, int c = 0) { return picture.row<float>(y)[4 * x + c]; }
double sum_of(const Image& picture, const Part& part) {
  double sum = 0;
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) sum += at(picture, part.x + x, part.y + y);
  return sum;
}

TEST(CentredPart, HasTheShapeAndCutsAsMuchOnBothSides) {
  EXPECT_EQ(centred_part({1600, 1200}, {16, 9}), (Part{0, 150, 1600, 900}));
  EXPECT_EQ(centred_part({1200, 1600}, {1, 1}), (Part{0, 200, 1200, 1200}));
  EXPECT_EQ(centred_part({2000, 500}, {640, 320}), (Part{500, 0, 1000, 500}));
  EXPECT_EQ(centred_part({33, 21}, {33, 21}), (Part{0, 0, 33, 21}));
}
TEST(CentredPart, AnOddTexelIsCutOnTheRightAndAtTheTop) {
  EXPECT_EQ(centred_part({641, 360}, {16, 9}), (Part{0, 0, 640, 360}));
  EXPECT_EQ(centred_part({640, 363}, {16, 9}), (Part{0, 1, 640, 360}));
  EXPECT_EQ(centred_part({11, 4}, {4, 4}), (Part{3, 0, 4, 4}));
}
// 854 x 480 is 16:9 as far as whole texels can be.
TEST(CentredPart, ATexelThatBelongsInPartIsKept) {
  EXPECT_EQ(centred_part({854, 480}, {16, 9}), (Part{0, 0, 854, 480}));
  EXPECT_EQ(centred_part({1366, 768}, {16, 9}), (Part{0, 0, 1366, 768}));
  EXPECT_EQ(centred_part({1, 65536}, {65536, 1}), (Part{0, 32767, 1, 1}));
}

TEST(Fitted, AConstantPictureStaysSoBitForBit) {
  constexpr float value[] = {0.1f, 1e-30f, 65504, 1.0f / 3};
  for (const Size from : {Size{7, 5}, {64, 64}, {1, 1}, {640, 3}, {101, 67}})
    for (const Size to : {Size{7, 5}, {64, 36}, {1, 1}, {13, 640}, {100, 66}}) {
      const Image out = fitted_to(make_image(Format::rgba32f, from[0], from[1], [&](int, int, int c) { return value[c]; }), to);
      ASSERT_TRUE(same(out, make_image(Format::rgba32f, to[0], to[1], [&](int, int, int c) { return value[c]; })))
          << from[0] << "x" << from[1] << " to " << to[0] << "x" << to[1];
    }
}
TEST(Fitted, OfTheSameSizeItIsThePicture) {
  const Image picture = noise_of(57, 31);
  EXPECT_TRUE(same(fitted_to(picture, {57, 31}), picture));
  // Nothing that is cut is mixed in.
  const Image cut = fitted_to(picture, {55, 31});
  EXPECT_TRUE(same(cut, make_image(Format::rgba32f, 55, 31, [](int x, int y, int c) { return noise(x + 1, y, c); })));
}
TEST(Fitted, ByAWholeFactorItIsTheMeanOfEachBox) {
  for (const Size by : {Size{2, 2}, {3, 3}, {7, 7}}) {
    const Image picture = noise_of(12 * by[0], 9 * by[1]), out = fitted_to(picture, {12, 9});
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 12; ++x) {
        const double mean = sum_of(picture, {x * by[0], y * by[1], by[0], by[1]}) / (by[0] * by[1]);
        ASSERT_NEAR(at(out, x, y), mean, 1e-7) << x << " " << y;
      }
  }
}
// Columns 0, 1/3, 2/3 and 1 of three texels lie in the two new ones as 1 : 1/2 and 1/2 : 1.
TEST(Fitted, ATexelInPartCountsByItsPart) {
  const Image picture = make_image(Format::rgba32f, 3, 1, [](int x, int, int) { return x == 0 ? 3.0f : x == 1 ? 6.0f : 30.0f; });
  const Image out = fitted(rows_of(picture), {3, 1}, {0, 0, 3, 1}, {2, 1});
  EXPECT_EQ(at(out, 0, 0), (3 + 6 * 0.5) / 1.5);
  EXPECT_EQ(at(out, 1, 0), (6 * 0.5 + 30) / 1.5);
}
TEST(Fitted, SmallerItKeepsTheLight) {
  const Image picture = noise_of(997, 613);
  for (const Size to : {Size{320, 180}, {99, 613}, {996, 7}, {1, 1}, {333, 333}}) {
    const Part part = centred_part(size_of(picture), to);
    if (part.width < to[0] || part.height < to[1]) continue;
    const double before = sum_of(picture, part) / (1.0 * part.width * part.height),
                 after = sum_of(fitted_to(picture, to), {0, 0, to[0], to[1]}) / (1.0 * to[0] * to[1]);
    EXPECT_NEAR(after, before, 1e-7) << to[0] << "x" << to[1];
  }
}
// Linear interpolation of a ramp is the ramp, and ends half a texel from the edge.
TEST(Fitted, LargerItIsLinearBetweenCentres) {
  const Image ramp = make_image(Format::rgba32f, 8, 8, [](int x, int y, int c) { return static_cast<float>(c == 0 ? x : c == 1 ? y : 1); });
  const Image out = fitted_to(ramp, {40, 40});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const auto place = [](int o) { return std::min(7.0, std::max(0.0, (o + 0.5) / 5 - 0.5)); };
      ASSERT_NEAR(at(out, x, y, 0), place(x), 1e-6);
      ASSERT_NEAR(at(out, x, y, 1), place(y), 1e-6);
      ASSERT_EQ(at(out, x, y, 2), 1);
    }
}
// One axis may shrink where the other grows; each row is then used by several new rows.
TEST(Fitted, AxesAreApart) {
  const Image picture = noise_of(60, 4);
  const Image both = fitted(rows_of(picture), {60, 4}, {0, 0, 60, 4}, {20, 12});
  const Image columns = fitted(rows_of(picture), {60, 4}, {0, 0, 60, 4}, {20, 4});
  const Image then = fitted(rows_of(columns), {20, 4}, {0, 0, 20, 4}, {20, 12});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 20; ++x) EXPECT_NEAR(at(both, x, y), at(then, x, y), 1e-7);
}

TEST(FittedNearest, EveryTexelIsOneOfTheCopy) {
  const Image depth = make_image(Format::r32f, 31, 17, [](int x, int y, int) { return static_cast<float>(100 * x + y); });
  for (const Size to : {Size{31, 17}, {64, 36}, {5, 3}, {16, 90}}) {
    const Part part = centred_part({310, 170}, to);
    const Image out = fitted_nearest(depth, {310, 170}, part, to);
    for (int y = 0; y < to[1]; ++y)
      for (int x = 0; x < to[0]; ++x) {
        // The new texel's centre in texels of the copy.
        const double u = (part.x + (x + 0.5) * part.width / to[0]) / 10, v = (part.y + (y + 0.5) * part.height / to[1]) / 10;
        const int column = static_cast<int>(out.row<float>(y)[x]) / 100, row = static_cast<int>(out.row<float>(y)[x]) % 100;
        ASSERT_LE(std::abs(u - (column + 0.5)), 0.5 + 1e-9) << x;
        ASSERT_LE(std::abs(v - (row + 0.5)), 0.5 + 1e-9) << y;
      }
  }
}
TEST(FittedNearest, OfTheSameSizeItIsTheCopyAndOnABorderTheTexelOnTheRight) {
  const Image depth = make_image(Format::r32f, 6, 2, [](int x, int y, int) { return static_cast<float>(10 * x + y); });
  EXPECT_TRUE(same(fitted_nearest(depth, {6, 2}, {0, 0, 6, 2}, {6, 2}), depth));
  EXPECT_TRUE(same(fitted_nearest(depth, {6, 2}, {0, 0, 6, 2}, {3, 1}),
                   make_image(Format::r32f, 3, 1, [](int x, int, int) { return static_cast<float>(10 * (2 * x + 1) + 1); })));
}
// The part belongs to the picture beside which the copy lies: what a depth of half the size shows does not move.
TEST(FittedNearest, ACopyOfAnotherSizeStaysInPlace) {
  const auto mark = [](int texels) {
    return make_image(Format::r32f, texels, 1, [=](int x, int, int) { return x < texels / 4 ? 1.0f : 2.0f; });
  };
  const Part part{10, 0, 60, 1};
  const Image of_80 = fitted_nearest(mark(80), {80, 1}, part, {120, 1});
  EXPECT_TRUE(same(fitted_nearest(mark(40), {80, 1}, part, {120, 1}), of_80));
  EXPECT_TRUE(same(fitted_nearest(mark(800), {80, 1}, part, {120, 1}), of_80));
}

}  // namespace
}  // namespace rainref
