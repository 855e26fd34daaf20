// A picture with depths as rays meet it, against plates and walls that can be met on paper.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "image/images.h"
#include "truth/picture_relief.h"

namespace rainref::truth {
namespace {

constexpr int columns = 64, rows = 48;
constexpr double half_width = 0.8, half_height = 0.6;

/// Red: the column, green: the row, both at texel centres; blue as given.
Image ramps() {
  return make_image(Format::rgba32f, columns, rows, [](int x, int y, int c) {
    return c == 0 ? static_cast<float>(x) + 0.5f : c == 1 ? static_cast<float>(y) + 0.5f : c == 2 ? 0.0f : 1.0f;
  });
}
template <class Of>
Image depths(const Of& of) {
  return make_image(Format::r32f, columns, rows, [&](int x, int, int) { return static_cast<float>(of(x)); });
}

TEST(PictureRelief, APlateIsMetWhereItStands) {
  constexpr double far = 7;
  const scene::Camera camera{{1, 2, 3}, {4, 2.5, -6}, {0, 1, 0}, 40};
  const scene::Camera::Basis b = camera.basis();
  const PictureRelief relief(camera, half_width, half_height, ramps(), depths([](int) { return far; }));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  int inside = 0;
  for (int n = 0; n < 2000; ++n) {
    const double z = 0.6 + 0.3 * unit(random);
    const Vec origin = camera.position + z * b.forward + 0.3 * unit(random) * b.right + 0.3 * unit(random) * b.up;
    const Vec direction = scene::normalized(b.forward + 0.5 * unit(random) * b.right + 0.4 * unit(random) * b.up);
    const PictureRelief::Sight seen = relief.look(origin, direction);
    const double way = (far - z) / dot(direction, b.forward);
    EXPECT_NEAR(seen.distance, way, 1e-12 * way);  // a few roundings of doubles
    const Vec at = origin + way * direction - camera.position;
    const double x = (0.5 + 0.5 * dot(at, b.right) / (far * half_width)) * columns,
                 y = (0.5 + 0.5 * dot(at, b.up) / (far * half_height)) * rows;
    if (x < 0.5 || x > columns - 0.5 || y < 0.5 || y > rows - 0.5) continue;
    ++inside;
    EXPECT_NEAR(seen.radiance.x, x, 1e-10);  // bilinear lookups of a ramp give it back
    EXPECT_NEAR(seen.radiance.y, y, 1e-10);
  }
  EXPECT_GT(inside, 1000);
}

/// At the origin, along -z; a wall stands at x = 0 between a plate at 2 m to the left and one at 10 m to the right.
struct Corner {
  scene::Camera camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40};
  PictureRelief relief{camera, half_width, half_height, ramps(), depths([](int x) { return x < columns / 2 ? 2 : 10; })};
  /// From (x, depth 1) toward (to, depth 10).
  PictureRelief::Sight look(double x, double to) const { return relief.look({x, 0, -1}, scene::normalized(Vec(to - x, 0, -9))); }
  /// The depth at which it ends.
  double depth(double x, double to) const { return 1 + look(x, to).distance * scene::normalized(Vec(to - x, 0, -9)).z * -1; }
};
TEST(PictureRelief, WhatStandsNearHidesWhatIsBehindIt) {
  const Corner c;
  EXPECT_NEAR(c.depth(-0.5, 1.0), 2, 1e-12);   // it passes 2 m at x = -1/3: the near plate
  EXPECT_NEAR(c.depth(-0.1, 1.0), 10, 1e-12);  // at x = 1/45: past the near plate
  EXPECT_NEAR(c.depth(0.5, 0.2), 10, 1e-12);
  // It comes to x = 0 at 4 m, behind the edge of the near plate: to a texel, 2 half_width / columns of the picture at 4 m, which the
  // ray crosses in 4 m / (1/6 + ...) of its way.
  EXPECT_NEAR(c.depth(0.5, -1.0), 4, 0.5);
  EXPECT_LT(c.look(0.5, -1.0).radiance.x, columns / 2 + 1.0);
  EXPECT_GT(c.look(0.5, -1.0).radiance.x, columns / 2 - 1.0);
}

TEST(PictureRelief, BeyondThePictureItsEdgeGoesOn) {
  const Corner c;
  const PictureRelief::Sight right = c.relief.look({0.5, 0, -1}, scene::normalized(Vec(5, 0, -1)));
  EXPECT_EQ(right.radiance.x, columns - 0.5);
  EXPECT_NEAR(right.distance, 9 * std::sqrt(26.0), 1e-10);
  for (const Vec& away : {Vec(-1, 0, 0), scene::normalized(Vec(-1, 0, 0.5))}) {
    const PictureRelief::Sight seen = c.relief.look({0.5, 0, -1}, away);
    EXPECT_TRUE(std::isinf(seen.distance));
    EXPECT_EQ(seen.radiance.x, 0.5);
  }
}

TEST(Uncovered, WhatIsHiddenIsLikeTheNearestThatIsNot) {
  const Image colour = ramps();
  Image depth = depths([](int x) { return x >= 10 && x <= 13 ? 0.3 : 5; }), surface(Format::rgba32f, columns, rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) surface.row<float>(y)[4 * x + 2] = 0.5f;
  for (const int y : {0, 20, 21}) std::fill_n(depth.row<float>(y), columns, 0.5f);  // at the glass is not behind it
  const Uncovered out = uncovered(colour, depth, surface);
  const auto at = [&](int x, int y) {
    const float* c = out.colour.row<float>(y) + 4 * x;
    return std::pair<float, float>(c[0], c[1]);
  };
  EXPECT_EQ(at(9, 5), std::pair(9.5f, 5.5f));
  EXPECT_EQ(at(11, 5), std::pair(9.5f, 5.5f));
  EXPECT_EQ(at(12, 5), std::pair(14.5f, 5.5f));
  EXPECT_EQ(out.depth.row<float>(5)[11], 5);
  EXPECT_EQ(at(30, 0), std::pair(30.5f, 1.5f));
  EXPECT_EQ(at(30, 20), std::pair(30.5f, 19.5f));
  EXPECT_EQ(at(30, 21), std::pair(30.5f, 22.5f));
  EXPECT_EQ(at(12, 21), std::pair(14.5f, 22.5f));
  const Uncovered nothing = uncovered(colour, depths([](int) { return 0.1; }), surface);
  for (int y = 0; y < rows; ++y)
    EXPECT_TRUE(std::equal(colour.row<float>(y), colour.row<float>(y) + 4 * columns, nothing.colour.row<float>(y)));
}

}  // namespace
}  // namespace rainref::truth
