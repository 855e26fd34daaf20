// Wipers of a further pane as a user meets them: a pack and its verdicts. Keys and drops: tests/windshield/pane_wipers_test.cpp.
#include <filesystem>

#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

class RearWiper : public CommandLine {
 protected:
  RearWiper() {
    put(folder / "corrected.toml", R"(effect = "windshield"
variant = "corrected"
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
)");
    before = folder.names();
  }
};

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
