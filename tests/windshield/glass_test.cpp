// The plane of the glass against geometry: corners to axes, frame, metric, normal.
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

TEST(Glass, TheDefaultHasItsSidesSlopeAndNormal) {
  const Glass g = default_glass();
  EXPECT_NEAR(g.area, 1.4 * 0.8, 1e-14);
  EXPECT_NEAR(g.normal[0], std::sin(27 * degree), 1e-15);
  EXPECT_NEAR(g.normal[1], 0, 1e-15);
  EXPECT_NEAR(g.normal[2], std::cos(27 * degree), 1e-15);
  const PlaneFrame plane = g.plane(), axes = g.axes();
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(plane.frame[k], axes.frame[k], 1e-15);  // it is not sheared
}

// Seen from inside the corners are lower left, lower right and upper left, wherever in the car the pane stands: the normal looks away from
// whoever sees them so. The other order is a glass seen from the other side.
TEST(Glass, TheOrderOfTheCornersSaysWhichSideIsOutside) {
  const auto expect_normal = [](const Corners& corners, const Real3& out) {
    const Glass g = make_glass(corners), other = make_glass({corners[0], corners[2], corners[1]});
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(g.normal[k], out[k], 1e-15);
      EXPECT_NEAR(other.normal[k], -out[k], 1e-15);
    }
  };
  const double half = std::sqrt(0.5);
  expect_normal({{{2, 0.7, 1}, {2, -0.7, 1}, {1.5, 0.7, 1.5}}}, {half, 0, half});       // a windshield
  expect_normal({{{-1, -0.6, 1}, {-1, 0.6, 1}, {-0.6, -0.6, 1.4}}}, {-half, 0, half});  // a rear window
  expect_normal({{{0, 0.8, 1}, {1, 0.8, 1}, {0, 0.8, 1.5}}}, {0, 1, 0});                // upright on the left
  expect_normal({{{1, -0.8, 1}, {0, -0.8, 1}, {1, -0.8, 1.5}}}, {0, -1, 0});            // and on the right
  expect_normal({{{0, 0.8, 1}, {1, 0.8, 1}, {0, 1.2, 1.4}}}, {0, half, -half});         // it leans outward at the top
  expect_normal({{{1, -0.5, 1.6}, {1, 0.5, 1.6}, {2, -0.5, 1.6}}}, {0, 0, 1});          // a roof, seen looking up, head to the front
}

// Distances in the plane frame are distances in space, on any sheared glass; and inverse and metric are what they are
// called.
TEST(Glass, ThePlaneKeepsDistancesOnAShearedGlass) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const auto vector = [&] { return Real3{number(random), number(random), number(random)}; };
    const std::array<Real3, 3> corners{vector(), vector(), vector()};
    const Glass g = make_glass(corners);
    const PlaneFrame plane = g.plane();
    const double condition = g.metric[0] * g.metric[2] / (g.area * g.area);
    const double du = number(random), dv = number(random);
    Real3 in_space{};
    for (int k = 0; k < 3; ++k) in_space[k] = du * g.e_u[k] + dv * g.e_v[k];
    const Real2 in_plane = plane.to_plane({du, dv});
    EXPECT_NEAR(in_plane[0] * in_plane[0] + in_plane[1] * in_plane[1], dot(in_space, in_space), 1e-14 * condition);
    const Real2 back = plane.to_glass(in_plane);
    EXPECT_NEAR(back[0], du, 1e-14 * condition);
    EXPECT_NEAR(back[1], dv, 1e-14 * condition);
    EXPECT_NEAR(g.metric[0] * g.inverse_metric[0] + g.metric[1] * g.inverse_metric[1], 1, 1e-14 * condition);
    EXPECT_NEAR(g.metric[0] * g.inverse_metric[1] + g.metric[1] * g.inverse_metric[2], 0, 1e-14 * condition);
    EXPECT_NEAR(plane.frame[0] * plane.frame[2], g.area, 1e-14);
    EXPECT_NEAR(dot(g.normal, g.e_u), 0, 1e-14 * condition);
    EXPECT_NEAR(dot(g.normal, g.e_v), 0, 1e-14 * condition);
  }
}

TEST(Glass, CornersOnALineAreRefused) {
  for (const std::array<Real3, 3>& corners :
       {std::array<Real3, 3>{{{1, 2, 3}, {1, 2, 3}, {0, 1, 0}}}, std::array<Real3, 3>{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}},
        std::array<Real3, 3>{{{0, 0, 0}, {1, 0, 0}, {1, 1e-8, 0}}}}) {
    EXPECT_THAT(error_of([&] { make_glass(corners); }),
                testing::AllOf(testing::StartsWith("2 "), testing::HasSubstr("windshield.corner_0"),
                               testing::HasSubstr("windshield.corner_2"), testing::HasSubstr("which lie on one line")));
  }
  EXPECT_NO_THROW(make_glass({{{0, 0, 0}, {1, 0, 0}, {1, 1e-5, 0}}}));
}

}  // namespace
}  // namespace rainref::windshield
