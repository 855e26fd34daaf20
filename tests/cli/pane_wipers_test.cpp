// Wipers of a further pane as a user meets them: keys, hashes, a pack and its verdicts.
#include <filesystem>

#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

class RearWiper : public CommandLine {
 protected:
  RearWiper() {
    for (const char* variant : {"corrected", "as-published"})
      put(folder / fmt::format("{}.toml", variant), fmt::format(R"(effect = "windshield"
variant = "{}"
[run]
frames = 8
fps = 30
size = [24, 16]
[vehicle]
speed = 0
[pane_1_wipers]
count = 1
cycles_per_minute = 60
[windshield]
panes = "1.0 0.75 0.95, 1.9 0.8 1.0, 1.1 0.7 1.4"
height_size = [32, 18]
[scene]
size = [16, 9]
moves = false
)",
                                                                variant));
    before = folder.names();
  }
};

TEST_F(RearWiper, ItsPassesAreHashedAndSetAndDescribed) {
  for (const std::string scene : {"corrected.toml", "as-published.toml"}) {
    const auto with = hash({scene}), without = hash({scene, "--set", "pane_1_wipers.count=0"});
    // A line is of all steps of a pass in a frame.
    const auto of = [](const std::vector<std::string>& lines, const std::string& pass) {
      std::vector<std::string> found;
      for (const std::string& line : lines)
        if (line.starts_with("7 " + pass + " ")) found.push_back(line);
      return found;
    };
    for (const char* pass : {"wipe_drops", "wipe_texture"}) {
      EXPECT_FALSE(of(with, pass).empty()) << pass;
      EXPECT_NE(of(with, pass), of(without, pass)) << pass;
    }
    EXPECT_EQ(of(with, "windshield_frame"), of(without, "windshield_frame"));
    EXPECT_NE(hash({scene, "--set", "pane_1_wipers.cycles_per_minute=80"}), with);
    EXPECT_EQ(hash({scene, "--set", "pane_1_wipers.key_frames=0 fast", "--set", "pane_1_wipers.fast_cycles_per_minute=60"}), with);
  }
  EXPECT_THAT(rainref({"describe", "windshield"}).out,
              testing::AllOf(HasSubstr("pane_1_wipers.count"), HasSubstr("pane_2_wipers.sweep_1"), Not(HasSubstr("pane_3_wipers"))));
  expect_refusal({"run", "corrected.toml", "-o", "o", "--set", "pane_2_wipers.count=1"}, 2,
                 HasSubstr("--set pane_2_wipers.count: expected none, for windshield.panes has 1 pane"));
}

// The reference's own outputs pass; a port that does not wipe the rear window fails there and nowhere else.
TEST_F(RearWiper, ItsPassesAreJudged) {
  const Outcome packed = rainref({"pack", "corrected.toml", "--at", "6", "-o", "pack"});
  ASSERT_EQ(packed.code, 0) << packed.err;
  for (const char* of_pane : {"wipe_drops/0006.1", "wipe_texture/0006.1"})
    EXPECT_TRUE(std::filesystem::exists(folder / "pack" / (std::string("windshield.") + of_pane))) << of_pane;
  std::filesystem::copy(folder / "pack", folder / "port", std::filesystem::copy_options::recursive);
  std::filesystem::remove(folder / "port/manifest.json");
  const Outcome right = rainref({"validate", "pack", "--port", "port"});
  for (const char* pass : {"PASS      wipe_drops", "PASS      wipe_texture"}) EXPECT_THAT(right.out, HasSubstr(pass));
  const std::string mask = "windshield.wipe_texture/0006.1/out.mask.npy";
  std::string dry = contents(folder / "port" / mask);
  std::fill(dry.begin() + 128, dry.end(), '\0');
  ASSERT_NE(dry, contents(folder / "port" / mask)) << "it wipes nothing";
  put(folder / "port" / mask, dry);
  const Outcome wrong = rainref({"validate", "pack", "--port", "port"});
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.out, HasSubstr("FAIL      wipe_texture"));
  EXPECT_THAT(wrong.out, HasSubstr("windshield.wipe_texture/0006.1/out.mask"));
  EXPECT_THAT(wrong.out, Not(HasSubstr("windshield.wipe_texture/0006.0/out.mask")));
}

}  // namespace
}  // namespace rainref::cli
