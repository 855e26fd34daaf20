// Pillar and dashboard before the glass: where they stand, and that they hide what is behind and nothing else.
#include "windshield/picture/picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/images.h"
#include "math/half.h"
#include "windshield/golden_scenes.h"
#include "windshield/scalar.h"

namespace rainref::windshield {
namespace {

constexpr int width = 320, height = 180;
/// An upright glass, 1.4 m wide and 0.8 m high, 1 m before an eye in its middle that looks straight at it.
const Corners upright{{{1, 0.7, 0.8}, {1, -0.7, 0.8}, {1, 0.7, 1.6}}};
PictureSettings eye() {
  PictureSettings p;
  p.width = width;
  p.height = height;
  p.camera_position = {0, 0, 1.2};
  p.camera_target = {10, 0, 1.2};
  p.vertical_fov_deg = 2 * std::atan(0.45) * 180 / 3.14159265358979323846;
  return p;
}
InteriorSettings none() {
  InteriorSettings s;
  s.on = true;
  s.pillar = {0, 0};
  s.dashboard = 0;
  s.binnacle = 0;
  return s;
}
double channel(const Image& image, double x, double y, int c) {
  const int column = static_cast<int>((x / 0.8 + 1) / 2 * width), row = static_cast<int>((y / 0.45 + 1) / 2 * height);
  return to_float(image.row<Half>(row)[4 * column + c]);
}
double alpha(const Image& image, double x, double y) { return channel(image, x, y, 3); }
Image drawn(const InteriorSettings& s) { return draw_interior(s, eye(), upright, parallel::Executor(2)); }
/// Share of a row or a column that is hidden.
double hidden(const Image& image) {
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) sum += to_float(image.row<Half>(y)[4 * x + 3]);
  return sum / (width * height);
}

TEST(Interior, WithoutPartsThereIsNoLightAndNothingHidden) {
  const Image image = drawn(none());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 4 * width; ++x) ASSERT_EQ(image.row<Half>(y)[x].bits, 0);
}
// Its edge runs from x = -0.5 at the glass' lower end, y = -0.4, to x = -0.3 at the upper one, y = 0.4, at distance 1.
TEST(Interior, ThePillarStandsLeftOfItsEdge) {
  InteriorSettings s = none();
  s.pillar = {1.0 / 7, 2.0 / 7};
  const Image image = drawn(s);
  for (const double y : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
    const double edge = -0.4 + 0.25 * y;
    EXPECT_EQ(alpha(image, edge - 0.02, y), 1) << y;
    EXPECT_EQ(alpha(image, edge + 0.02, y), 0) << y;
  }
  // A trapezium over the full height of the picture, 0.9: 0.4 of 1.6 in the mean; edges of centres, a texel at both ends.
  EXPECT_NEAR(hidden(image), 0.25, 0.5 / width);
  EXPECT_GT(channel(image, -0.6, 0, 0), 0);
}
// v = 1/4: 0.2 m over the lower end, y = -0.2, level; the hood rises straight ahead by its height, and nowhere else.
TEST(Interior, TheDashboardLiesUnderItsEdgeWithAHoodStraightAhead) {
  InteriorSettings s = none();
  s.dashboard = 0.25;
  EXPECT_NEAR(hidden(drawn(s)), 0.25 / 0.9, 0.5 / height);
  s.binnacle = 0.1;
  const Image image = drawn(s);
  EXPECT_EQ(alpha(image, 0, -0.115), 1);
  EXPECT_EQ(alpha(image, 0, -0.085), 0);
  for (const double x : {-0.6, 0.6}) {
    EXPECT_EQ(alpha(image, x, -0.215), 1);
    EXPECT_EQ(alpha(image, x, -0.185), 0);
  }
  PictureSettings aside = eye();
  aside.camera_target = {10, 3, 1.2};  // to the left: ahead is 0.3 to the right
  const Image turned = draw_interior(s, aside, upright, parallel::Executor(2));
  EXPECT_EQ(alpha(turned, 0.3, -0.12), 1);
  EXPECT_EQ(alpha(turned, -0.3, -0.115), 0);
}
// An edge is as wide as the pupil where texels are finer: half hidden in its middle, 2.5 mm to each side all or nothing.
TEST(Interior, EdgesAreAsSoftAsAnEyeOnTheStreetSeesThem) {
  InteriorSettings s = none();
  s.dashboard = 0.5;  // y = 0
  PictureSettings fine = eye();
  fine.width = 8;
  fine.height = 2048;
  const Image image = draw_interior(s, fine, upright, parallel::Executor(2));
  for (int row = 0; row < fine.height; ++row) {
    const double y = ((row + 0.5) / fine.height * 2 - 1) * 0.45, expected = std::min(std::max(0.5 - y / 0.005, 0.0), 1.0);
    ASSERT_NEAR(to_float(image.row<Half>(row)[4 * 3 + 3]), expected, 0x1p-11 + 1e-9) << row;
  }
}
TEST(Interior, TheGlassMirrorsTheDashboardAsLightThatHidesNothing) {
  InteriorSettings s = none();
  s.dashboard = 0.25;
  s.reflection = 1;
  const Image image = drawn(s);
  const double near = channel(image, 0.3, -0.18, 1), far = channel(image, 0.3, 0.1, 1);
  EXPECT_EQ(alpha(image, 0.3, -0.18), 0);
  EXPECT_GT(near, 10 * far);
  EXPECT_GT(far, 0);
  s.reflection = 0;
  EXPECT_EQ(channel(drawn(s), 0.3, -0.18, 1), 0);
}
TEST(Interior, SameBitsForAnyThreads) {
  const Image expected = draw_interior({}, eye(), upright, parallel::Executor(1));
  for (const int threads : {2, 3, 8}) {
    parallel::Executor several(threads);
    several.shuffle_tiles(5);
    ASSERT_TRUE(same(draw_interior({}, eye(), upright, several), expected)) << threads;
  }
}

const std::string wide_rain = std::string(wet_drive) + "[camera]\nvertical_fov_deg = 44\n[rain]\nrate = 120\n";
// What stands there has its own light alone; what is open is what it was, with what the glass mirrors added; water does not hear of it.
TEST(Interior, HidesWhatIsBehindAndNothingElse) {
  const parallel::Executor executor(2);
  const auto running = [&](const std::string& more) {
    Windshield w(config_of("corrected", wide_rain + more), small_surroundings(), executor);
    for (int n = 0; n < 5; ++n) w.next_frame();
    return w;
  };
  const Windshield open = running(""), inside = running("[interior]\non = true\nreflection = 0\nlight = 0.5\n");
  const scene::Config config = config_of("corrected", wide_rain + "[interior]\non = true\nreflection = 0\nlight = 0.5\n");
  const Settings s = settings_from(config);
  const Image drawn = draw_interior(s.interior, s.picture, s.corners, executor);
  int dark = 0, clear = 0;
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 97; ++x) {
      const Half* part = drawn.row<Half>(y) + 4 * x;
      for (int k = 0; k < 3; ++k) {
        const double seen = to_float(inside.colour().row<Half>(y)[4 * x + k]), was = to_float(open.colour().row<Half>(y)[4 * x + k]);
        if (to_float(part[3]) == 1) {
          ++dark;
          ASSERT_EQ(seen, 0.5 * to_float(part[k])) << x << ' ' << y;  // half of a half is one
        } else if (to_float(part[3]) == 0) {
          ++clear;
          ASSERT_EQ(seen, was) << x << ' ' << y;
        }
      }
    }
  }
  EXPECT_GT(dark, 1000);
  EXPECT_GT(clear, 5000);
  EXPECT_TRUE(same(open.height(), inside.height()));
}

}  // namespace
}  // namespace rainref::windshield
