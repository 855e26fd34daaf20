// What the passes of drops declare where they run without others.
#include "drops/info.h"

#include <gtest/gtest.h>

namespace rainref::drops {
namespace {

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
