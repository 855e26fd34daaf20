// The executor without threads: this program is linked with src/parallel/pool_serial.cpp in place of oneTBB's.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "golden/recorded.h"
#include "golden/scenes.h"
#include "rainref/error.h"
#include "rainref/executor.h"

namespace rainref::parallel {
namespace {

TEST(SerialExecutor, RunsEveryPieceOnceInOrderInTheCallersThread) {
  const Executor executor(8);
  const std::thread::id caller = std::this_thread::get_id();
  EXPECT_EQ(executor.threads(), 1);
  EXPECT_EQ(Executor().threads(), 1);
  std::vector<std::int64_t> seen;
  executor.for_range(10, 4, [&](std::int64_t begin, std::int64_t end) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    for (std::int64_t i = begin; i < end; ++i) seen.push_back(i);
  });
  EXPECT_EQ(seen, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(SerialExecutor, RunsLoopsInLoops) {
  const Executor executor;
  int visits = 0;
  executor.for_range(3, 1, [&](std::int64_t, std::int64_t) { executor.for_tiles(5, 4, 2, 2, [&](const Tile&) { ++visits; }); });
  EXPECT_EQ(visits, 3 * 6);
}

TEST(SerialExecutor, AnExceptionComesBack) {
  const Executor executor;
  int visits = 0;
  EXPECT_THROW(executor.for_range(9, 1,
                                  [&](std::int64_t i, std::int64_t) {
                                    ++visits;
                                    if (i == 4) throw Error(ExitCode::io, "disk full");
                                  }),
               Error);
  EXPECT_EQ(visits, 5);
  EXPECT_THROW(Executor(-1), Error);
  EXPECT_THROW(Executor(Executor::max_threads + 1), Error);
}

// The first frames of every effect; and traced pictures without Embree: src/compositor/tracer_bvh.cpp is in its place.
TEST(SerialExecutor, HasTheRecordedBits) {
  for (const auto& [name, scenes] : golden::scenes()) {
    const int frames = name == "compositor" ? 60 : 3;
    for (const golden::Scene& scene : scenes)
      ASSERT_EQ(scene.lines(Executor(2), frames, golden::call_plainly), golden::recorded(scene.name + " ", frames)) << scene.name;
  }
}

}  // namespace
}  // namespace rainref::parallel
