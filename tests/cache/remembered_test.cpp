// What was made is given again, and the memory keeps what was used last.
#include "cache/remembered.h"

#include <gtest/gtest.h>

namespace rainref::cache {
namespace {

class Memory : public testing::Test {
 protected:
  Memory() { remember(100); }
  ~Memory() override { remember(0); }
  /// Which of these are there.
  std::string known() {
    std::string all;
    for (const char* name : {"a", "b", "c", "d"})
      if (held.find(name)) all += name;
    return all;
  }
  void keep(const std::string& name, std::size_t bytes) { held.keep(name, std::make_shared<int>(1), bytes); }
  Remembered<int> held;
};

TEST_F(Memory, GivesWhatWasMadeBefore) {
  int made = 0;
  const auto make = [&] { return ++made; };
  const auto bytes = [](int) { return std::size_t{10}; };
  EXPECT_EQ(*held.get("a", bytes, make), 1);
  EXPECT_EQ(*held.get("a", bytes, make), 1);
  EXPECT_EQ(*held.get("b", bytes, make), 2);
  remember(0);
  EXPECT_EQ(*held.get("a", bytes, make), 3);
}

TEST_F(Memory, HoldsTheBytesThatItMayThoseUsedLast) {
  for (const char* name : {"a", "b", "c"}) keep(name, 33);
  EXPECT_EQ(known(), "abc");
  held.find("a");
  keep("d", 33);
  EXPECT_EQ(known(), "acd");
  keep("b", 100);
  EXPECT_EQ(known(), "b");
  keep("c", 101);
  EXPECT_EQ(known(), "b");
}

}  // namespace
}  // namespace rainref::cache
