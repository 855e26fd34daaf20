// Roofs over the water: where no rain falls, how much falls elsewhere, and that it is the same rain.

#include <gmock/gmock.h>

#include "puddle/rainfall.h"
#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

using testing::HasSubstr;

/// 40 x 30 cells of 2 cm in heavy rain without images beyond the edges.
Settings raining(const std::string& roofs) {
  Settings s = corrected(8, 8);
  s.boundary = Boundary::fixed;
  s.rain_rate = 100;
  s.smallest_drop = 0.2;
  s.shelter = roofs;
  return s;
}
Rainfall rain_of(const Settings& s, const Image& picture = {}) { return Rainfall(s, 1, shelter_of(s, picture)); }

TEST(PuddleShelter, TextsOfRoofs) {
  EXPECT_TRUE(parse_roofs("").empty());
  ASSERT_EQ(parse_roofs("0 -1 2 3.5; -1 -1 1 1;").size(), 2U);
  EXPECT_EQ(parse_roofs("0 -1 2 3.5")[0].z1, 3.5);
  for (const char* wrong : {"0 0 1", "0 0 1 1 1", "1 0 0 1", "0 0 0 1", "0 0 1 x", "0 0 1 1e9"})
    EXPECT_THAT(error_of([&] { parse_roofs(wrong); }), HasSubstr("rain.shelter, roof 1: expected \"x0 z0 x1 z1\"")) << wrong;
}
// Under the roof nothing; beside it the drops of the open sky, each where and as large as it was.
TEST(PuddleShelter, NoDropFallsUnderARoofAndTheOthersFallAsWithout) {
  const Settings s = raining("-0.1 -0.2 0.2 0.1");  // cells 15 to 30 and 5 to 20
  const Rainfall open = rain_of(raining("")), sheltered = rain_of(s);
  int all = 0, fallen = 0;
  for (int step = 0; step < 400; ++step) {
    std::vector<Drop> expected;
    for (const Drop& d : open.drops(step)) {
      ++all;
      if (!(d.x >= 15 && d.x < 30 && d.y >= 5 && d.y < 20)) expected.push_back(d);
    }
    const std::vector<Drop> drops = sheltered.drops(step);
    ASSERT_EQ(drops.size(), expected.size());
    for (std::size_t i = 0; i < drops.size(); ++i) {
      EXPECT_EQ(drops[i].x, expected[i].x);
      EXPECT_EQ(drops[i].y, expected[i].y);
      EXPECT_EQ(drops[i].amplitude, expected[i].amplitude);
    }
    fallen += static_cast<int>(drops.size());
  }
  EXPECT_GT(all, 5000);
  const double share = 1 - 15.0 * 15 / (40 * 30);
  EXPECT_NEAR(static_cast<double>(fallen) / all, share, 4 * std::sqrt(share * (1 - share) / all));
}
// A cell that a roof covers in part gets that share of its rain: 16 bits of a word of their own.
TEST(PuddleShelter, CellsAreThinnedByTheirShare) {
  const Settings s = raining("-0.4 -0.3 0.005 0.3");  // half of the rectangle and a quarter of column 20
  const Shelter shelter = shelter_of(s, {});
  ASSERT_EQ(shelter.cells.size(), 1200U);
  EXPECT_EQ(shelter.cells[0].open, 0U);
  EXPECT_EQ(shelter.cells[19].open, 0U);
  EXPECT_EQ(shelter.cells[20].open, 49152U);
  EXPECT_EQ(shelter.cells[21].open, 65536U);
  EXPECT_EQ(shelter.cells[1199].open, 65536U);
  const Rainfall open = rain_of(raining("")), sheltered = rain_of(s);
  int all = 0, fallen = 0;
  const auto in_column = [](const Drop& d) { return d.x >= 20 && d.x < 21; };
  for (int step = 0; step < 4000; ++step) {
    const std::vector<Drop> a = open.drops(step), b = sheltered.drops(step);
    all += static_cast<int>(std::count_if(a.begin(), a.end(), in_column));
    fallen += static_cast<int>(std::count_if(b.begin(), b.end(), in_column));
  }
  EXPECT_GT(all, 2000);
  EXPECT_NEAR(static_cast<double>(fallen) / all, 0.75, 4 * std::sqrt(0.75 * 0.25 / all));
}
TEST(PuddleShelter, APictureSaysItToo) {
  Image picture(Format::rgba32f, 2, 3);  // row 0 lies at the least z
  const float shares[6] = {0, 1, 1, 1, 1, 0.25f};
  for (int k = 0; k < 6; ++k) picture.row<float>(k / 2)[4 * (k % 2)] = shares[k];
  const Settings s = raining("");
  int lower = 0, upper = 0, other = 0;
  for (int step = 0; step < 2000; ++step) {
    for (const Drop& d : rain_of(s, picture).drops(step)) {
      if (d.x < 20 && d.y < 10)
        ++lower;
      else if (d.x >= 20 && d.y >= 20)
        ++upper;
      else
        ++other;
    }
  }
  EXPECT_EQ(lower, 0);
  EXPECT_NEAR(upper, 0.25 * other / 4, 4 * std::sqrt(0.25 * other / 4) * 1.2);
  EXPECT_THAT(error_of([&] { shelter_of(raining("0 0 1 1"), picture); }),
              HasSubstr("rain.shelter: expected none beside rain.shelter_image"));
}
// Images beyond an edge go with their drop.
TEST(PuddleShelter, AWallsMirrorImagesGoWithTheirDrop) {
  Settings s = raining("-1 -1 1 1");
  s.boundary = Boundary::reflecting;
  for (int step = 0; step < 100; ++step) EXPECT_TRUE(rain_of(s).drops(step).empty());
}
// Hostile packs: another shelter or more objects than there are.
TEST(PuddleShelter, RecordsThatDoNotFitAreRefused) {
  const Settings s = raining("0 0 1 1");
  const Rainfall rain = rain_of(s);
  RainfallUniforms u = rain.uniforms(0);
  const RainTables tables{rain.craters(), rain.count_thresholds(), rain.shelter(), {}};
  EXPECT_NO_THROW(drops_of(u, tables));
  ++u.shelter_rows;
  EXPECT_THAT(error_of([&] { drops_of(u, tables); }), HasSubstr("expected a shelter of 40 x 31"));
  u = rain.uniforms(0, 1);
  EXPECT_THAT(error_of([&] { drops_of(u, tables); }), HasSubstr("1 objects, found 1200 and 0 records"));
}

}  // namespace
}  // namespace rainref::puddle::test
