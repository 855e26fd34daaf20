// Open decisions: every combination of answers is run once, and more than four are too many.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "math/enclosure.h"
#include "math/profiles.h"
#include "rainref/error.h"

namespace rainref::enclosed {
namespace {

const Enclosure open(-1.0f, 1.0f), zero(0.0f);

// Bits of k comparisons that the interval leaves open.
std::vector<int> runs_of(int thresholds, bool* whole) {
  std::vector<int> seen;
  PathEnumeration paths;
  *whole = paths.for_each_alternative([&] {
    int bits = 0;
    for (int i = 0; i < thresholds; ++i) bits = 2 * bits + (open < zero);
    seen.push_back(bits);
  });
  return seen;
}

TEST(PathEnumeration, RunsEveryCombinationOnce) {
  for (int thresholds = 0; thresholds <= 2; ++thresholds) {
    bool whole = false;
    const std::vector<int> seen = runs_of(thresholds, &whole);
    EXPECT_TRUE(whole);
    EXPECT_EQ(seen.size(), 1u << thresholds);
    EXPECT_EQ(std::set<int>(seen.begin(), seen.end()).size(), seen.size());
  }
}
TEST(PathEnumeration, MoreThanFourAlternativesAreTooMany) {
  for (int thresholds = 3; thresholds <= 8; ++thresholds) {
    bool whole = true;
    const std::vector<int> seen = runs_of(thresholds, &whole);
    EXPECT_FALSE(whole) << thresholds;
    EXPECT_LE(seen.size(), 4u);
  }
}
// A loop that may end at each of its rounds: one alternative for each exit, not two to the power of the rounds.
TEST(PathEnumeration, EarlyExitsAddUp) {
  for (int limit = 1; limit <= 5; ++limit) {
    std::vector<int> rounds;
    PathEnumeration paths;
    const bool whole = paths.for_each_alternative([&] {
      int n = 0;
      while (n < limit && open < zero) ++n;
      rounds.push_back(n);
    });
    EXPECT_EQ(whole, limit + 1 <= PathEnumeration::max_runs) << limit;
    if (!whole) continue;
    std::vector<int> expected;
    for (int n = 0; n <= limit; ++n) expected.push_back(n);
    EXPECT_EQ(rounds, expected);
    EXPECT_EQ(paths.runs(), limit + 1);
  }
}
TEST(PathEnumeration, TiesOfPointsAreSettled) {
  PathEnumeration paths;
  const Enclosure a(0.5f), b(0.5f);
  ASSERT_TRUE(paths.for_each_alternative([&] {
    EXPECT_FALSE(a < b);
    EXPECT_FALSE(a > b);
    EXPECT_TRUE(a <= b);
    EXPECT_TRUE(a >= b);
    EXPECT_EQ(floor(Enclosure(3.0f)).lo, 3.0f);
    EXPECT_TRUE(paths.decisions().empty());
  }));
  EXPECT_EQ(paths.runs(), 1);
}
TEST(PathEnumeration, ReportsHowItAnswered) {
  std::vector<std::vector<int>> logs;
  PathEnumeration paths;
  ASSERT_TRUE(paths.for_each_alternative([&] {
    const float cell = floor(Enclosure(1.5f, 3.5f)).lo;
    std::vector<int> log;
    for (const Decision d : paths.decisions()) log.insert(log.end(), {d.chosen, d.count});
    logs.push_back(log);
    EXPECT_EQ(cell, 1.0f + static_cast<float>(log[0]));
  }));
  EXPECT_EQ(logs, (std::vector<std::vector<int>>{{0, 3}, {1, 3}, {2, 3}}));
}
TEST(PathEnumeration, NestsAndRestores) {
  PathEnumeration outer;
  int runs = 0;
  ASSERT_TRUE(outer.for_each_alternative([&] {
    const bool first = open < zero;
    PathEnumeration inner;
    ASSERT_TRUE(inner.for_each_alternative([&] { (void)(open < zero); }));
    EXPECT_EQ(inner.runs(), 2);
    EXPECT_EQ(outer.decisions().size(), 1u);
    EXPECT_EQ(outer.decisions()[0].chosen, first);
    ++runs;
  }));
  EXPECT_EQ(runs, 2);
}
TEST(PathEnumeration, AnOpenDecisionOutsideIsADefect) {
  EXPECT_THROW((void)(open < zero), Error);
  EXPECT_THROW((void)to_int(open), Error);
}
// Too many cells: the interval of their numbers where they are computed with, the end of the invocation where they
// fetch.
TEST(PathEnumeration, ManyCellsStayANumberButGiveNoIndex) {
  const Enclosure wide(0.5f, 9.5f);
  PathEnumeration paths;
  EXPECT_TRUE(paths.for_each_alternative([&] {
    EXPECT_EQ(floor(wide).lo, 0.0f);
    EXPECT_EQ(floor(wide).hi, 9.0f);
    EXPECT_EQ(fract(wide).lo, 0.0f);
    EXPECT_EQ(fract(wide).hi, 1.0f);
  }));
  EXPECT_FALSE(paths.for_each_alternative([&] { EXPECT_EQ(to_int(floor(wide)).i, 0); }));
}
TEST(ProfileScope, HoldsForItsLifeAndNests) {
  EXPECT_EQ(profile().name, "ieee");
  {
    const ProfileScope outer(test::profile_named("vulkan"));
    EXPECT_EQ(profile().name, "vulkan");
    {
      const ProfileScope inner(test::profile_named("cuda"));
      EXPECT_EQ(profile().name, "cuda");
    }
    EXPECT_EQ(profile().name, "vulkan");
  }
  EXPECT_EQ(profile().name, "ieee");
}

}  // namespace
}  // namespace rainref::enclosed
