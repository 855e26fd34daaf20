// Tables that repeat another are found by their names.
#include "scene/key_groups.h"

#include <gtest/gtest.h>

namespace rainref::scene {
namespace {

TEST(KeyGroups, TablesAndTheirRepetitions) {
  EXPECT_EQ(table_of("puddle.damping"), "puddle");
  EXPECT_EQ(table_of("seed"), "");
  EXPECT_EQ(repeated_table("pane_1_wipers"), "wipers");
  EXPECT_EQ(repeated_table("pane_12_wipers"), "wipers");
  for (const char* table : {"", "wipers", "pane_1", "pane1_wipers", "1_wipers", "pane_wipers"})
    EXPECT_EQ(repeated_table(table), "") << table;
  EXPECT_TRUE(is_basic("rain.rate"));
  EXPECT_FALSE(is_basic("rain.smallest_drop"));
}

}  // namespace
}  // namespace rainref::scene
