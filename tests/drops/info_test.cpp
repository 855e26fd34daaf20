#include "drops/info.h"

#include <gtest/gtest.h>

namespace rainref::drops {
namespace {

TEST(DropsInfo, BlocksAndRecordsHaveOneLayoutInEveryLanguage) {
  // Making them validates them: Error(internal) otherwise.
  EXPECT_EQ(records().size(), 4u);
  EXPECT_EQ(spawn_info({"wipe_drops", "merge"}).uniforms.front().size, 48u);
  EXPECT_EQ(integrate_info("spawn", "windshield_frame").uniforms.front().size, 64u);
  EXPECT_EQ(merge_info("wipe_drops", "merge").uniforms.front().size, 48u);
}

TEST(DropsInfo, BuffersOfPassesAreDeclared) {
  std::vector<std::string> names;
  for (const auto& b : buffers()) names.push_back(b.name);
  for (const auto& pass : {spawn_info({"wipe_drops", "merge"}), integrate_info("spawn", "windshield_frame"), merge_info("wipe_drops", "merge")}) {
    for (const auto& read : pass.reads) EXPECT_NE(std::find(names.begin(), names.end(), read.buffer), names.end()) << read.buffer;
    for (const auto& written : pass.writes) EXPECT_NE(std::find(names.begin(), names.end(), written), names.end()) << written;
  }
}

}  // namespace
}  // namespace rainref::drops
