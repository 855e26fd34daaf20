// Whole numbers are cut toward zero and held in their range, for every float.
#include "math/whole.h"

#include <gtest/gtest.h>

#include <limits>

namespace rainref {
namespace {

TEST(Whole, IsCutAndHeld) {
  EXPECT_EQ(whole_within(2.99, 0, 9), 2);
  EXPECT_EQ(whole_within(-2.99, -9, 9), -2);
  EXPECT_EQ(whole_within(-0.5, 0, 9), 0);
  EXPECT_EQ(whole_within(9.5, 0, 9), 9);
  EXPECT_EQ(whole_within(0, 0, 0), 0);
}

TEST(Whole, IsDefinedForEveryNumber) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(whole_within(infinity, -5, 9), 9);
  EXPECT_EQ(whole_within(-infinity, -5, 9), -5);
  EXPECT_EQ(whole_within(1e300, -5, 9), 9);
  EXPECT_EQ(whole_within(std::numeric_limits<double>::quiet_NaN(), -5, 9), -5);
}

}  // namespace
}  // namespace rainref
