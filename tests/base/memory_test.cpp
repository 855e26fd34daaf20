#include "base/memory.h"

#include <gtest/gtest.h>

namespace rainref {
namespace {

TEST(Memory, IsWrittenInTheUnitThatSuitsIt) {
  EXPECT_EQ(memory_text(0), "0.0 MiB");
  EXPECT_EQ(memory_text(12u << 20), "12.0 MiB");
  EXPECT_EQ(memory_text((1023u << 20) + (1u << 19)), "1023.5 MiB");
  EXPECT_EQ(memory_text(1u << 30), "1.0 GiB");
  EXPECT_EQ(memory_text(std::size_t{3} << 29), "1.5 GiB");
}

TEST(Memory, ThisMachineHasSome) {
  EXPECT_GT(physical_memory(), std::size_t{1} << 26);
  EXPECT_LT(physical_memory(), std::size_t{1} << 50);
}

}  // namespace
}  // namespace rainref
