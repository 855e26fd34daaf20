// A team does each piece of a loop once before the next loop begins, whichever thread is late or throws.
#include "parallel/team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rainref::parallel {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;

// Threads of the test's own, of which some go at once and some wait for long.
class Crew {
 public:
  Crew(Team& team, int helpers, nanoseconds patience) : team_(team) {
    for (int place = 1; place <= helpers; ++place) {
      threads_.emplace_back([&team, &end = end_, place, patience] {
        while (!end.load()) team.help(place, patience), std::this_thread::yield();
      });
    }
  }
  ~Crew() {
    end_ = true;
    team_.stop();
    for (std::thread& t : threads_) t.join();
  }

 private:
  Team& team_;
  std::atomic<bool> end_{false};
  std::vector<std::thread> threads_;
};

const auto nothing = [] {};

// Each loop reads what the one before wrote at another place, without atomics: under the thread sanitizer a loop that returns too
// early, or a helper that begins too early or ends too late, is reported; elsewhere its numbers are wrong.
TEST(Team, EachPieceIsDoneOnceAndBeforeTheNextLoop) {
  for (const int helpers : {0, 1, 3}) {
    for (const nanoseconds patience : {nanoseconds(0), nanoseconds(seconds(10))}) {
      Team team(4);
      const Crew crew(team, helpers, patience);
      constexpr int loops = 300;
      for (const std::int64_t count : {1, 3, 4, 61}) {
        std::vector<std::int64_t> now(static_cast<std::size_t>(count)), next(now);
        for (int k = 0; k < loops; ++k) {
          ASSERT_TRUE(team.run(
              count, [&](std::int64_t i) { next[static_cast<std::size_t>(i)] = now[static_cast<std::size_t>((i + 1) % count)] + 1 + i; },
              nothing));
          now.swap(next);
        }
        // Around the ring each number has met every summand equally often, but for the last round.
        std::int64_t all = 0;
        for (const std::int64_t v : now) all += v;
        ASSERT_EQ(all, loops * count * (count + 1) / 2);
        for (std::int64_t i = 0; i < count; ++i) {
          std::int64_t expected = 0;
          for (int k = 0; k < loops; ++k) expected += 1 + (i + k) % count;
          ASSERT_EQ(now[static_cast<std::size_t>(i)], expected);
        }
      }
    }
  }
}

TEST(Team, HelpersTakeWhatIsLeftAndBeginWhenTheyAreCalled) {
  Team team(3);
  const Crew crew(team, 2, seconds(10));
  // Three pieces that wait for each other need three threads.
  std::atomic<int> there{0};
  int begun = 0;
  EXPECT_TRUE(team.run(
      3,
      [&](std::int64_t) {
        ++there;
        const auto until = std::chrono::steady_clock::now() + seconds(20);
        while (there < 3 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
      },
      [&] { ++begun; }));
  EXPECT_EQ(there, 3);
  EXPECT_EQ(begun, 1);
}

TEST(Team, ALoopInALoopIsRefusedAndTheOuterOneGoesOn) {
  Team team(2);
  int visits = 0;
  std::vector<bool> inner;
  EXPECT_TRUE(team.run(
      5,
      [&](std::int64_t) {
        ++visits;
        inner.push_back(team.run(
            2, [&](std::int64_t) { ++visits; }, nothing));
      },
      nothing));
  EXPECT_EQ(visits, 5);
  EXPECT_EQ(inner, std::vector<bool>(5, false));
}

TEST(Team, AnExceptionOfAnyThreadComesBackAndTheNextLoopIsWhole) {
  Team team(3);
  const Crew crew(team, 2, seconds(10));
  for (int k = 0; k < 100; ++k) {
    EXPECT_THROW(team.run(
                     40, [&](std::int64_t i) { i % 40 == k % 40 ? throw std::runtime_error("piece") : void(); }, nothing),
                 std::runtime_error);
    std::atomic<int> visits{0};
    EXPECT_TRUE(team.run(
        40, [&](std::int64_t) { ++visits; }, nothing));
    ASSERT_EQ(visits, 40);
  }
}

// An address sanitizer, or that of threads, reports one that does; without, pieces of a loop that is over are counted.
TEST(Team, AHelperThatComesLateFindsTheLoopClosed) {
  Team team(2);
  int visits = 0;
  for (int k = 0; k < 10; ++k) {
    EXPECT_TRUE(team.run(
        3, [&](std::int64_t) { ++visits; }, nothing));
    team.help(1, nanoseconds(0));
  }
  EXPECT_EQ(visits, 30);
}

TEST(Team, HelpersGoWhenTheirPatienceEndsOrTheyAreTold) {
  Team team(2);
  team.help(1, nanoseconds(0));  // returns
  std::thread waiting([&] { team.help(1, std::chrono::hours(10)); });
  team.stop();
  waiting.join();
}

}  // namespace
}  // namespace rainref::parallel
