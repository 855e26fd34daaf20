// Races: runs on the same inputs that differ.
#include "judge/races.h"

#include "judge/mini_port.h"

#include <gmock/gmock.h>

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;

TEST(Races, TheFirstElementAndTheirNumberAreNamed) {
  MiniPort port("puddle-corrected");
  TemporaryFolder runs;
  port.run(runs / "1");
  port.run(runs / "2");
  EXPECT_TRUE(find_races(port.pack, {runs / "1", runs / "2"}, "").empty());

  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() == "puddle.display/0012.0") out[0].levels[0][4 * (35 * 2 + 3) + 1] ^= std::byte{1};
  };
  port.run(runs / "3");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "puddle.display/0012.0") return;
    out[0].levels[0][4 * (35 * 2 + 3) + 1] ^= std::byte{2};
    out[0].levels[0][4 * (35 * 9 + 8) + 2] ^= std::byte{2};
  };
  port.run(runs / "4");
  const std::vector<std::filesystem::path> folders{runs / "1", runs / "2", runs / "3", runs / "4"};
  const std::vector<Race> races = find_races(port.pack, folders, "");
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(
      races[0].text(),
      "race: puddle.display/0012.0/out.picture differs between runs 1 and 3 on the same inputs, first at (3, 2).y, 2 of 2940 elements");
  EXPECT_TRUE(find_races(port.pack, folders, "shade").empty());

  PortJudgement j = judge(port.pack, runs / "1");
  ASSERT_EQ(j.status, Status::pass) << why(j);
  add_races(races, j);
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_EQ(j.first_bad_pass, "display");
  EXPECT_EQ(pass_of(j, "display").reason, races[0].text());
  EXPECT_EQ(pass_of(j, "shade").status, Status::pass);
}

TEST(Races, MoreRecordsInOneRunAreOne) {
  MiniPort port("puddle-corrected");
  TemporaryFolder runs;
  port.run(runs / "1");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "puddle.raindrops/0012.1") return;
    out[0].levels[0].resize(out[0].levels[0].size() + out[0].record.size);
    ++out[0].width;
  };
  port.run(runs / "2");
  const std::vector<Race> races = find_races(port.pack, {runs / "1", runs / "2"}, "");
  ASSERT_EQ(races.size(), 1u);
  EXPECT_TRUE(races[0].records);
  EXPECT_EQ(races[0].differing, 1);
  EXPECT_EQ(races[0].x, static_cast<int>(races[0].of) - 1);
}

}  // namespace
}  // namespace rainref::judge
