// The version is made of its three numbers, and the golden generation counts from one.
#include "rainref/version.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rainref {
namespace {

TEST(Version, IsMadeOfItsThreeNumbers) {
  EXPECT_EQ(version(), fmt::format("{}.{}.{}", RAINREF_VERSION_MAJOR, RAINREF_VERSION_MINOR, RAINREF_VERSION_PATCH));
}

TEST(Version, GenerationsCountFromOne) { EXPECT_GE(golden_generation, 1u); }

}  // namespace
}  // namespace rainref
