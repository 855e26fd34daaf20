// The executor without threads: this program is linked with src/parallel/pool_serial.cpp in place of oneTBB's.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "edge_splash/golden_scenes.h"
#include "golden/golden_check.h"
#include "puddle/golden_scenes.h"
#include "rainref/error.h"
#include "rainref/executor.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "truth/golden_scenes.h"
#include "windshield/golden_scenes.h"

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

template <class Scenes>
void expect_the_recorded_bits(const Scenes& scenes) {
  for (const auto& scene : scenes) golden::expect_as_recorded(scene);
}
TEST(SerialExecutor, PuddleHasTheRecordedBits) { expect_the_recorded_bits(puddle::golden_scenes()); }
TEST(SerialExecutor, WindshieldHasTheRecordedBits) { expect_the_recorded_bits(windshield::golden_scenes()); }
TEST(SerialExecutor, EdgeSplashHasTheRecordedBits) { expect_the_recorded_bits(edge_splash::golden_scenes()); }
TEST(SerialExecutor, ScreenDropsHasTheRecordedBits) { expect_the_recorded_bits(screen_drops::golden_scenes()); }
// And without Embree: src/compositor/tracer_bvh.cpp is in its place.
TEST(SerialExecutor, TracedPicturesHaveTheRecordedBits) { expect_the_recorded_bits(truth::golden_scenes()); }
TEST(SerialExecutor, RainyGlassHasTheRecordedBits) { expect_the_recorded_bits(rainy_glass::golden_scenes()); }

}  // namespace
}  // namespace rainref::parallel
