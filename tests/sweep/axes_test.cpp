// Axes of a sweep run from end to end, and their keys may be quoted.
#include "sweep/axes.h"

#include <random>

#include <gtest/gtest.h>

namespace rainref::sweep {
namespace {

scene::RawValue real(double x) { return {x, {}}; }
scene::RawValue whole(std::int64_t x) { return {x, {}}; }

// 0.2 + 3 * (1 - 0.2) / 3 is 1.0000000000000002 in double, which a range of at most 1 refuses.
TEST(Range, ItsEndsAreThemselves) {
  EXPECT_EQ(std::get<double>(range(real(0.2), real(1), 4).back().data), 1.0);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-10, 10);
  for (int i = 0; i < 2000; ++i) {
    const double from = any(random), to = any(random);
    const int count = 2 + i % 50;
    const auto values = range(real(from), real(to), count);
    ASSERT_EQ(values.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(std::get<double>(values.front().data), from);
    EXPECT_EQ(std::get<double>(values.back().data), to);
    for (std::size_t k = 1; k < values.size(); ++k) {
      const double a = std::get<double>(values[k - 1].data), b = std::get<double>(values[k].data);
      EXPECT_TRUE(from < to ? a < b : a > b);
    }
  }
}

TEST(Range, IsOfWholeNumbersWhereAllAre) {
  const auto values = range(whole(10), whole(2), 5);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(std::get<std::int64_t>(values[k].data), 10 - 2 * k);
  EXPECT_EQ(std::get<double>(range(whole(0), whole(1), 3)[1].data), 0.5);
  EXPECT_EQ(std::get<std::int64_t>(range(whole(7), whole(7), 1)[0].data), 7);
  // A difference that no double holds exactly, nor a step.
  EXPECT_EQ(range(whole(INT64_MIN), whole(INT64_MAX), 2).size(), 2u);
}

TEST(Axes, KeysAreTheSameQuotedOrNot) {
  EXPECT_EQ(unquoted("\"rain.rate\""), "rain.rate");
  EXPECT_EQ(unquoted("rain.\"rate\""), "rain.rate");
}

}  // namespace
}  // namespace rainref::sweep
