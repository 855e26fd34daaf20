// The street that passes: views between two keyframes against the street itself.
#include "windshield/street.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/half.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

constexpr int width = 160, height = 90;

scene::Camera ahead() {
  scene::Camera c;
  c.position = {0.6, 0, 1.32};
  c.target = {10, 0, 1.5};
  c.up = {0, 0, 1};
  c.vertical_fov_deg = 30;
  return c;
}
/// What is seen after `distance`.
SceneView seen(const StreetOptions& options, double distance) {
  const parallel::Executor executor(2);
  StreetDrive drive(ahead(), width, height, options, executor);
  SceneView view;
  EXPECT_TRUE(drive.look(distance, true, view));
  return view;
}
/// Mean difference of two pictures as they are displayed, roughly: lamps count as white.
double difference(const SceneView& a, const SceneView& b) {
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 4 * width; ++x) {
      if (x % 4 == 3) continue;
      const auto shown = [&](const SceneView& v) { return std::min(to_float(v.colour.row<Half>(y)[x]), 1.0f); };
      sum += std::abs(static_cast<double>(shown(a)) - shown(b));
    }
  return sum / (3.0 * width * height);
}

// At a keyframe the view is the street; between, it comes nearer the closer keyframes are.
TEST(StreetDrive, MoreKeyframesComeNearerToTheStreet) {
  const StreetOptions once{20, 2, true, 1};
  StreetOptions often = once;
  often.keyframes = 6;
  double off_once = 0, off_often = 0;
  for (const double distance : {5.0, 19.0, 43.0}) {
    StreetOptions here = once;
    here.start = once.start + distance;
    const SceneView truth = seen(here, 0);
    off_once += difference(seen(once, distance), truth);
    off_often += difference(seen(often, distance), truth);
  }
  EXPECT_LT(off_often, 0.6 * off_once);
  // Six keyframes in 12 m: one is after 4 m.
  StreetOptions here = once;
  here.start = once.start + 4;
  EXPECT_LT(difference(seen(often, 4), seen(here, 0)), 0.1 * off_once / 3);
}

// The street begins again after 396 m, with any number of keyframes.
TEST(StreetDrive, BeginsAgainAtItsLength) {
  for (const int keyframes : {1, 5}) {
    const StreetOptions options{20, 2, false, keyframes};
    const SceneView first = seen(options, 2 * StreetDrive::street_length);
    EXPECT_EQ(difference(first, seen(options, 0)), 0) << keyframes;
    EXPECT_GT(difference(first, seen(options, 100)), 0.001) << keyframes;
  }
}

}  // namespace
}  // namespace rainref::windshield
