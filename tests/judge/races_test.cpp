// Races: runs on the same inputs that differ.
#include "judge/races.h"

#include "judge/mini_port.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;

std::vector<std::string> passes_of(const capture::Pack& pack) {
  std::vector<std::string> out;
  for (const capture::PackPass& p : pack.passes) out.push_back(p.name);
  return out;
}

TEST(Races, TheFirstElementAndTheirNumberAreNamed) {
  MiniPort port("puddle-corrected");
  TemporaryFolder runs;
  port.run(runs / "1");
  port.run(runs / "2");
  EXPECT_TRUE(find_races(port.pack, {runs / "1", runs / "2"}, passes_of(port.pack)).found.empty());

  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() == "puddle.display/0012.0") out[0].levels[0].edit()[4 * (35 * 2 + 3) + 1] ^= std::byte{1};
  };
  port.run(runs / "3");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "puddle.display/0012.0") return;
    out[0].levels[0].edit()[4 * (35 * 2 + 3) + 1] ^= std::byte{2};
    out[0].levels[0].edit()[4 * (35 * 9 + 8) + 2] ^= std::byte{2};
  };
  port.run(runs / "4");
  const std::vector<std::filesystem::path> folders{runs / "1", runs / "2", runs / "3", runs / "4"};
  const std::vector<Race> races = find_races(port.pack, folders, passes_of(port.pack)).found;
  ASSERT_EQ(races.size(), 1u);
  EXPECT_EQ(
      races[0].text(),
      "race: puddle.display/0012.0/out.picture differs between runs 1 and 3 on the same inputs, first at (3, 2).y, 2 of 2940 elements");
  EXPECT_TRUE(find_races(port.pack, folders, {"shade"}).found.empty());

  PortJudgement j = judge(port.pack, runs / "1");
  ASSERT_EQ(j.status, Status::pass) << why(j);
  add_races(races, j);
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_EQ(j.first_bad_pass, "display");
  EXPECT_EQ(pass_of(j, "display").reason, races[0].text());
  EXPECT_EQ(pass_of(j, "shade").status, Status::pass);
}

// What one run lacks is listed; what all have is compared.
TEST(Races, ARunWithoutAFileHidesNoRace) {
  MiniPort port("puddle-corrected");
  TemporaryFolder runs;
  port.run(runs / "1");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() == "puddle.display/0012.0") out[0].levels[0].edit()[5] ^= std::byte{1};
  };
  port.run(runs / "2");
  std::filesystem::remove(runs / "1/puddle.shade/0011.0/out.colour.npy");  // validate's
  std::filesystem::remove(runs / "2/puddle.shade/0012.0/out.colour.npy");
  const Races races = find_races(port.pack, {runs / "1", runs / "2"}, passes_of(port.pack));
  ASSERT_EQ(races.found.size(), 1u);
  EXPECT_EQ(races.found[0].id, "puddle.display/0012.0");
  ASSERT_EQ(races.files.size(), 1u);
  EXPECT_EQ(races.files[0].id, "puddle.shade/0012.0");
}

TEST(Races, MoreRecordsInOneRunAreOne) {
  MiniPort port("puddle-corrected");
  TemporaryFolder runs;
  port.run(runs / "1");
  port.after = [](const PassCase& c, std::vector<Array>& out) {
    if (c.folder() != "puddle.raindrops/0012.1") return;
    out[0].levels[0].edit().resize(out[0].levels[0].size() + out[0].record.size);
    ++out[0].width;
  };
  port.run(runs / "2");
  const std::vector<Race> races = find_races(port.pack, {runs / "1", runs / "2"}, passes_of(port.pack)).found;
  ASSERT_EQ(races.size(), 1u);
  EXPECT_TRUE(races[0].records);
  EXPECT_EQ(races[0].differing, 1);
  EXPECT_EQ(races[0].x, static_cast<int>(races[0].of) - 1);
}

}  // namespace
}  // namespace rainref::judge
