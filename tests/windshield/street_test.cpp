// The street that passes: views between two keyframes against the street itself.
#include "windshield/scene/street.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "determinism.h"
#include "image/images.h"
#include "math/half.h"
#include "night_street/night_street.h"
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
SceneView seen(const StreetOptions& options, double distance, bool clear_lane = true) {
  const parallel::Executor executor(2);
  StreetDrive drive(night_street::Street::make({2, clear_lane}), ahead(), width, height, options, executor);
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
  const StreetOptions once{20, 1};
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

// A level road whose brightness is a straight line of the distance, seen from a place after one keyframe, or before one: the picture's rows
// show that line. Where a depth counted for its whole row, each row was off by up to half a row's distance, and the road got scan lines.
TEST(StreetDrive, ALevelRoadKeepsItsTextureFromRowToRow) {
  constexpr double half_height = 0.3, half_width = half_height * width / height, eye = 1.3;
  const auto of_row = [&](int y) { return (2 * (y + 0.5) / height - 1) * half_height; };  // slope of the ray, up
  Keyframe k{Image(Format::rgba16f, width, height), Image(Format::r32f, width, height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double depth = of_row(y) < -0.02 ? eye / -of_row(y) : 1000;
      k.depth.row<float>(y)[x] = static_cast<float>(depth);
      for (int c = 0; c < 4; ++c) k.colour.row<Half>(y)[4 * x + c] = to_half(static_cast<float>(std::min(depth, 100.0) / 64));
    }
  for (const double way : {4.0, -2.0}) {
    ReprojectUniforms u{};
    u.half_size[0] = static_cast<float>(half_width);
    u.half_size[1] = static_cast<float>(half_height);
    u.pixel[0] = static_cast<float>(2 * half_width / width);
    u.pixel[1] = static_cast<float>(2 * half_height / height);
    u.forward[2] = 1;
    u.behind_by = way > 0 ? 4 : 10;
    u.ahead_by = -2;
    u.share = way > 0 ? 0 : 1;
    SceneView view{Image(Format::rgba16f, width, height), Image(Format::r32f, width, height)};
    reproject_rows(u, k, k, view, {0, 0, width, height});
    for (int y = 0; y < height; ++y) {
      const double depth = eye / -of_row(y), there = depth + way;
      if (there < 4.6) continue;     // below the edge of that picture
      if (of_row(y) > -0.09) break;  // beyond, neighbouring rows lie too far apart to be one surface
      const double shown = 64 * static_cast<double>(to_float(view.colour.row<Half>(y)[4 * (width / 2)])) - way;
      // A straight line between rows that are r apart overestimates the distance d by up to r^2 / 4 d: once in the depth, once in the
      // colour. A half has 11 bits, stored twice.
      const double r = there * there / eye * 2 * half_height / height;
      EXPECT_NEAR(shown, depth, 2 * r * r / (4 * there) + 2 * there * 0x1p-11) << y << ": rows are " << r << " m apart";
    }
  }
}

// The views are an input of passes: their bits are compared between targets.
TEST(StreetDrive, EveryTargetThreadCountOrderAndWidthGivesTheSameViews) {
  const auto keyframe = [](float shift) {
    return Keyframe{
        make_image(Format::rgba16f, 19, 13,
                   [=](int x, int y, int c) { return to_half(shift + 0.0625f * static_cast<float>((7 * x + 13 * y + 5 * c) % 17)); }),
        make_image(Format::r32f, 19, 13, [=](int x, int y, int) { return 40 * shift + static_cast<float>((3 * x + 11 * y) % 31); })};
  };
  const Keyframe behind = keyframe(0), ahead = keyframe(0.25f);
  const ReprojectUniforms u{{0.6f, 0.3f}, {0.05f, 0.05f}, {0.01f, -0.02f, 0.99f}, 2.5f, -5.5f, 0.4f};
  for (int columns = 1; columns <= 33; ++columns) {
    rainref::test::expect_one_result(fmt::format("width {}", columns), [&](const parallel::Executor& executor) {
      SceneView view{Image(Format::rgba16f, columns, 11), Image(Format::r32f, columns, 11)};
      executor.for_tiles(columns, 11, columns, 2, [&](const parallel::Tile& tile) { reproject_rows(u, behind, ahead, view, tile); });
      return capture::hash_of(view.colour).text() + capture::hash_of(view.depth).text();
    });
  }
  select_simd_target("");
}

// The street begins again after 396 m, with any number of keyframes.
TEST(StreetDrive, BeginsAgainAtItsLength) {
  for (const int keyframes : {1, 5}) {
    const StreetOptions options{20, keyframes};
    const SceneView first = seen(options, 2 * StreetDrive::street_length, false);
    EXPECT_EQ(difference(first, seen(options, 0, false)), 0) << keyframes;
    EXPECT_GT(difference(first, seen(options, 100, false)), 0.001) << keyframes;
  }
}

}  // namespace
}  // namespace rainref::windshield
