// The blocks, records and buffers that drops declares are those of its passes.
#include "drops/info.h"

#include <gtest/gtest.h>

namespace rainref::drops {
namespace {

TEST(DropsInfo, BlocksAndRecordsHaveOneLayoutInEveryLanguage) {
  // Making them validates them: Error(internal) otherwise.
  EXPECT_EQ(records().size(), 5u);
  EXPECT_EQ(spawn_info({"wipe_drops", "merge"}).uniforms.front().size, 48u);
  EXPECT_EQ(integrate_info("windshield_frame").uniforms.front().size, 64u);
  EXPECT_EQ(necks_info("wipe_drops").uniforms.front().size, 32u);
  EXPECT_EQ(merge_info("wipe_drops", "merge").uniforms.front().size, 48u);
}

TEST(DropsInfo, BuffersOfPassesAreDeclared) {
  std::vector<std::string> names;
  for (const auto& b : buffers()) names.push_back(b.name);
  for (const auto& pass : {spawn_info({"wipe_drops", "merge"}), integrate_info("windshield_frame"), necks_info("wipe_drops"),
                           merge_info("wipe_drops", "merge")}) {
    for (const auto& read : pass.reads) EXPECT_NE(std::find(names.begin(), names.end(), read.buffer), names.end()) << read.buffer;
    for (const auto& written : pass.writes) EXPECT_NE(std::find(names.begin(), names.end(), written), names.end()) << written;
  }
}

// Without wipers the film comes from the merge of the step before.
TEST(DropsInfo, MergeTakesItsOwnFilmFromTheStepBefore) {
  const auto film = [](const capture::PassInfo& merge) { return merge.reads.at(1); };
  EXPECT_TRUE(film(merge_info("integrate", "merge")).previous);
  EXPECT_FALSE(film(merge_info("wipe_drops", "wipe_drops")).previous);
}

TEST(DropsInfo, CorrectedOnlyLeavesNothingOfAsPublished) {
  const capture::PassInfo spawn = corrected_only(spawn_info({"integrate", "merge"}));
  EXPECT_EQ(spawn.variant("as-published"), nullptr);
  ASSERT_NE(spawn.variant("corrected"), nullptr);
  ASSERT_EQ(spawn.reads.size(), 3u);
  for (const capture::ReadInfo& r : spawn.reads) EXPECT_EQ(r.variant, "corrected");
  EXPECT_EQ(spawn.reads[0].from, "merge");
  int drops = 0;
  for (const capture::BufferInfo& b : corrected_only(buffers())) {
    EXPECT_EQ(b.variant, "corrected") << b.name;
    drops += b.name == "drops";
  }
  EXPECT_EQ(drops, 1);
}

}  // namespace
}  // namespace rainref::drops
