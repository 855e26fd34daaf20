// Every SIMD target, 1, 2, 3 and 8 threads and shuffled work give the same bits.
#include <gtest/gtest.h>

#include "determinism.h"
#include "screen_drops/flow_support.h"

namespace rainref::screen_drops {
namespace {

using namespace test;

std::string run(const FlowSettings& settings, const parallel::Executor& executor) {
  Flow flow(settings, executor);
  std::string all;
  for (int n = 0; n < 12; ++n) {
    flow.simulate();
    all += bytes_of(flow.height()) + bytes_of(flow.film()) + bytes_of(flow.drops());
  }
  const drops::MassBalance& balance = flow.mass_balance();
  return all + std::string(reinterpret_cast<const char*>(&balance), sizeof balance);
}

class FlowDeterminism : public testing::Test {
 protected:
  ~FlowDeterminism() override { select_simd_target(""); }
};

TEST_F(FlowDeterminism, EveryTargetAndThreadCount) {
  for (const auto& [width, height] : {std::array{1, 1}, std::array{33, 17}, std::array{89, 67}}) {
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      FlowSettings s = wet_pane();
      s.warm_up = 1;
      s.substeps = rounding == Rounding::rtz ? 3 : 1;
      s.splat.width = width;
      s.splat.height = height;
      s.splat.rounding = rounding;
      rainref::test::expect_one_result(fmt::format("width {}", width),
                                       [&](const parallel::Executor& executor) { return run(s, executor); });
      const std::string before = run(s, parallel::Executor(1));
      ++s.drops.seed;
      EXPECT_NE(run(s, parallel::Executor(1)), before);
    }
  }
}

}  // namespace
}  // namespace rainref::screen_drops
