// The executor does each piece once, for any number of threads, in the pinned floating-point state.
#include "rainref/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/error_of.h"
#include "base/hostile_state.h"
#include "rainref/error.h"

namespace rainref::parallel {
namespace {

constexpr int thread_counts[] = {1, 2, 3, 8};

TEST(Executor, EveryIndexIsVisitedOnceInChunksOfTheSizeGiven) {
  for (const int threads : thread_counts) {
    const Executor executor(threads);
    const auto check = [&](std::int64_t count, std::int64_t chunk) {
      std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
      std::atomic<int> calls = 0, wrong = 0;
      executor.for_range(count, chunk, [&](std::int64_t begin, std::int64_t end) {
        ++calls;
        wrong += begin % chunk != 0 || end != std::min(count, begin + chunk);
        for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      ASSERT_EQ(calls, (count + chunk - 1) / chunk);
      ASSERT_EQ(wrong, 0);
      for (const auto& v : visits) ASSERT_EQ(v, 1) << threads << " threads, " << count << " by " << chunk;
    };
    for (const std::int64_t count : {0, 1, 2, 7, 16, 17, 1000}) {
      for (const std::int64_t chunk : {1, 2, 3, 16, 1000, 5000}) {
        check(count, chunk);
      }
    }
  }
}

// Each piece in turn waits for all others: whosever share it is in, others must take what comes after it.
TEST(Executor, NoPieceWaitsBehindALongOne) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "there threads take turns, so that neighbours always run on different ones";
#endif
  const Executor executor(2);
  constexpr std::int64_t count = 7;
  for (std::int64_t slow = 0; slow < count; ++slow) {
    std::atomic<std::int64_t> done = 0;
    std::atomic<bool> too_late = false;
    executor.for_range(count, 1, [&](std::int64_t i, std::int64_t) {
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
      while (i == slow && done < count - 1 && !too_late) {
        if (std::chrono::steady_clock::now() > until) too_late = true;
        std::this_thread::yield();
      }
      ++done;
    });
    ASSERT_FALSE(too_late) << slow;
  }
}

TEST(Executor, RefusesMorePiecesThanItCanHandOut) {
  EXPECT_THROW(Executor(2).for_range((std::int64_t{1} << 31) + 1, 1, [](std::int64_t, std::int64_t) {}), Error);
  int calls = 0;
  Executor(1).for_range(std::numeric_limits<std::int64_t>::max(), std::int64_t{1} << 62, [&](std::int64_t, std::int64_t) { ++calls; });
  EXPECT_EQ(calls, 2);
}

TEST(Executor, ANegativeCountIsNothing) {
  Executor(2).for_range(-5, 1, [](std::int64_t, std::int64_t) { FAIL(); });
}

TEST(Executor, EveryTexelLiesInOneTileWhichStartsOnTheGrid) {
  for (const int threads : thread_counts) {
    const Executor executor(threads);
    for (const auto& [w, h] : {std::pair{1, 1}, {17, 5}, {64, 64}, {33, 100}, {300, 1}}) {
      for (const auto& [tw, th] : {std::pair{1, 1}, {16, 4}, {64, 64}, {7, 9}, {1 << 20, 1}, {1, 1 << 20}}) {
        const int width = w, height = h, tile_width = tw, tile_height = th;
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(width) * height);
        std::atomic<int> wrong = 0;
        executor.for_tiles(width, height, tile_width, tile_height, [&](const Tile& t) {
          wrong += t.x0 % tile_width != 0 || t.y0 % tile_height != 0 || t.x1 != std::min(width, t.x0 + tile_width) ||
                   t.y1 != std::min(height, t.y0 + tile_height);
          for (int y = t.y0; y < t.y1; ++y)
            for (int x = t.x0; x < t.x1; ++x) ++visits[static_cast<std::size_t>(y) * width + x];
        });
        ASSERT_EQ(wrong, 0);
        for (const auto& v : visits) ASSERT_EQ(v, 1);
      }
    }
  }
}

std::vector<std::int64_t> order_of(Executor& executor, std::uint64_t seed) {
  executor.shuffle_tiles(seed);
  std::vector<std::int64_t> order;
  executor.for_range(100, 1, [&](std::int64_t begin, std::int64_t) { order.push_back(begin); });
  return order;
}

TEST(Executor, ShufflesTheOrderAndNothingElse) {
  Executor one(1);
  const std::vector<std::int64_t> natural = order_of(one, 0), a = order_of(one, 1), b = order_of(one, 2);
  EXPECT_NE(a, natural);
  EXPECT_NE(a, b);
  EXPECT_EQ(order_of(one, 1), a);
  EXPECT_EQ(order_of(one, 0), natural);
  EXPECT_EQ(std::set<std::int64_t>(a.begin(), a.end()).size(), 100u);
  // Not the same order with a few exchanged: about one index in a hundred stays in its place.
  int in_place = 0;
  for (std::size_t i = 0; i < a.size(); ++i) in_place += a[i] == natural[i];
  EXPECT_LT(in_place, 10);
}

TEST(Executor, UsesAsManyThreadsAsItIsTold) {
  for (const int threads : thread_counts) {
    const Executor executor(threads);
    EXPECT_EQ(executor.threads(), threads);
    std::mutex mutex;
    std::set<std::thread::id> ids;
    executor.for_range(400, 1, [&](std::int64_t, std::int64_t) {
      const std::lock_guard lock(mutex);
      ids.insert(std::this_thread::get_id());
    });
    EXPECT_LE(static_cast<int>(ids.size()), threads);
  }
  EXPECT_GE(Executor(0).threads(), 1);
  EXPECT_EQ(Executor().threads(), Executor(0).threads());
}

TEST(Executor, SeveralReallyRunAtATime) {
  const Executor executor(2);
  std::atomic<int> waiting = 0;
  std::atomic<bool> met = false;
  executor.for_range(2, 1, [&](std::int64_t, std::int64_t) {
    ++waiting;
    for (int i = 0; i < 2000 && !met; ++i) {
      if (waiting == 2) met = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  EXPECT_TRUE(met);
}

TEST(Executor, RefusesThreadCountsOutsideItsRange) {
  for (const int threads : {-1, Executor::max_threads + 1, -2147483647}) {
    EXPECT_EQ(error_of([&] { const Executor executor(threads); }),
              "2 threads: expected a number from 1 to 1024, found " + std::to_string(threads));
  }
}

TEST(Executor, AnExceptionComesBackAndThePoolGoesOn) {
  for (const int threads : thread_counts) {
    const Executor executor(threads);
    for (int round = 0; round < 3; ++round) {
      const auto work = [](std::int64_t begin, std::int64_t) {
        if (begin == 17) throw Error(ExitCode::io, "disk full");
      };
      EXPECT_EQ(error_of([&] { executor.for_range(50, 1, work); }), "4 disk full");
      std::atomic<int> visits = 0;
      executor.for_range(50, 1, [&](std::int64_t, std::int64_t) { ++visits; });
      EXPECT_EQ(visits, 50);
    }
    EXPECT_THROW(executor.for_tiles(4, 4, 1, 1, [](const Tile&) { throw std::runtime_error("any"); }), std::runtime_error);
  }
}

TEST(Executor, LoopsInLoopsAndOfSeveralCallersAreWhole) {
  for (const int threads : thread_counts) {
    const Executor executor(threads);
    const auto rows_of_columns = [&] {
      std::vector<std::atomic<int>> visits(std::size_t{20} * 30);
      executor.for_range(20, 1, [&](std::int64_t row, std::int64_t) {
        executor.for_range(30, 4, [&](std::int64_t begin, std::int64_t end) {
          for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(30 * row + i)];
        });
      });
      for (const auto& v : visits) ASSERT_EQ(v, 1) << threads;
    };
    std::vector<std::thread> callers;
    for (int k = 0; k < 3; ++k)
      callers.emplace_back([&] {
        for (int round = 0; round < 20; ++round) rows_of_columns();
      });
    for (std::thread& caller : callers) caller.join();
  }
}

TEST(Executor, SeveralPoolsLiveSideBySide) {
  const Executor one(1), two(2), eight(8);
  std::atomic<int> visits = 0;
  for (const Executor* executor : {&one, &two, &eight, &one}) executor->for_range(20, 1, [&](std::int64_t, std::int64_t) { ++visits; });
  EXPECT_EQ(visits, 80);
}

// --- Floating-point state --------------------------------------------------------------------------------------------

class ExecutorState : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, ExecutorState, testing::ValuesIn(thread_counts));

TEST_P(ExecutorState, IsPinnedInEveryTileOfAHostileCallerAndThenGivenBack) {
  for (const test::HostileState& state : test::hostile_states()) {
    std::atomic<int> wrong = 0;
    std::uint64_t after = 0;
    {
      const test::KeepFloatingPoint keep;
      set_floating_point_control(state.control);
      const Executor executor(GetParam());  // the pool takes over the state it is made in
      executor.for_range(300, 1, [&](std::int64_t, std::int64_t) {
        wrong += floating_point_control() != pinned_floating_point_control || !probe_floating_point().good();
      });
      executor.for_tiles(16, 16, 4, 4, [&](const Tile&) { wrong += floating_point_control() != pinned_floating_point_control; });
      after = floating_point_control();
    }
    EXPECT_EQ(wrong, 0) << state.name;
    EXPECT_EQ(after, state.control) << state.name;
  }
}

TEST_P(ExecutorState, IsPinnedForACallerThatTurnsHostileLater) {
  const Executor executor(GetParam());
  executor.for_range(10, 1, [](std::int64_t, std::int64_t) {});
  std::atomic<int> wrong = 0;
  {
    const test::KeepFloatingPoint keep;
    set_floating_point_control(test::hostile_states().back().control);
    executor.for_range(300, 1, [&](std::int64_t, std::int64_t) { wrong += floating_point_control() != pinned_floating_point_control; });
  }
  EXPECT_EQ(wrong, 0);
}

TEST_P(ExecutorState, OfAHostileTaskLeaksNeitherToTheNextTileNorToTheCaller) {
  const Executor executor(GetParam());
  for (const test::HostileState& state : test::hostile_states()) {
    std::atomic<int> wrong = 0;
    executor.for_range(300, 1, [&](std::int64_t, std::int64_t) {
      wrong += floating_point_control() != pinned_floating_point_control;
      set_floating_point_control(state.control);
    });
    EXPECT_EQ(wrong, 0) << state.name;
    ASSERT_EQ(floating_point_control(), pinned_floating_point_control) << state.name;
    executor.for_range(300, 1, [&](std::int64_t, std::int64_t) { wrong += floating_point_control() != pinned_floating_point_control; });
    EXPECT_EQ(wrong, 0) << state.name;
  }
}

TEST_P(ExecutorState, OfAHostileTaskThatThrowsDoesNotLeakEither) {
  const Executor executor(GetParam());
  EXPECT_THROW(executor.for_range(20, 1,
                                  [](std::int64_t, std::int64_t) {
                                    set_floating_point_control(test::hostile_states().front().control);
                                    throw std::runtime_error("stop");
                                  }),
               std::runtime_error);
  EXPECT_EQ(floating_point_control(), pinned_floating_point_control);
  std::atomic<int> wrong = 0;
  executor.for_range(300, 1, [&](std::int64_t, std::int64_t) { wrong += floating_point_control() != pinned_floating_point_control; });
  EXPECT_EQ(wrong, 0);
}

// What scripts/full/sanitizers would find, it finds: two tiles write one place.
TEST(ExecutorDeathTest, TheThreadSanitizerSeesTilesThatWriteOnePlace) {
#ifndef __SANITIZE_THREAD__
  GTEST_SKIP() << "built without the thread sanitizer";
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto race = [] {
    int sum = 0;
    Executor(2).for_range(64, 1, [&](std::int64_t begin, std::int64_t) { sum += static_cast<int>(begin); });
    std::exit(sum == -1);
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}

}  // namespace
}  // namespace rainref::parallel
