// The determinism proof of the room: every SIMD target, 1, 2, 3 and 8 threads, shuffled chunks and 1 to 33 drops give the
// same bits. Those of one plain float after another: tests/windshield/determinism_test.cpp.
#include <gtest/gtest.h>

#include "determinism.h"
#include "support.h"

namespace rainref::drops {
namespace {

using rainref::test::expect_one_result;

GlassFrame glass() {
  GlassFrame g = test::glass_of(0.8, -4.4, 1.5, 9.0);
  g.acceleration[0] = 0.2f;
  for (int k = 0; k < 4; ++k) {
    g.spin[k] = 0.05f * static_cast<float>(k - 1);
    g.coriolis[k] = 0.1f * static_cast<float>(2 - k);
  }
  return g;
}
Settings settings(bool corrected) {
  Settings s;
  s.corrected = corrected;
  s.seed = 11;
  s.humidity = 0.3;
  s.rain_rate = 60;
  return s;
}
IntegrateUniforms integrate(bool corrected) { return integrate_uniforms(settings(corrected), test::frame, 1.0 / 60); }

// Everything that a run of the passes leaves: the arrays, the film, the balance.
std::string run(const std::vector<Drop>& start, bool corrected, int frames, const parallel::Executor& executor) {
  DropArrays a = test::arrays_of(start, static_cast<std::int64_t>(start.size()) + 20);
  Arrivals arrivals(settings(corrected));
  Merger merger;
  Image film(Format::r32f, 33, 17);
  MassBalance sum;
  const MergeUniforms merge = merge_uniforms(settings(corrected), test::frame, 1.0 / 60, 33, 17, 1);
  for (int n = 0; n < frames; ++n) {
    const SpawnPlan& plan = arrivals.plan({0.1, 0.8, -10}, n, 60, a.next_id(), a.free_slots());
    sum += spawn(executor, a, plan.uniforms, plan.thresholds, plan.masses, corrected);
    if (corrected) {
      sum += drops::integrate(executor, a, integrate(true), glass(), true);
      sum += merger.run(executor, a, merge, film);
    } else {
      sum += drops::integrate(executor, a, integrate(false), glass(), false);
    }
  }
  std::vector<Drop> drops;
  a.gather(drops, executor);
  std::string bytes(reinterpret_cast<const char*>(drops.data()), drops.size() * sizeof(Drop));
  for (int y = 0; y < 17; ++y) bytes.append(reinterpret_cast<const char*>(film.row<float>(y)), 33 * sizeof(float));
  return bytes + std::string(reinterpret_cast<const char*>(&sum), sizeof sum);
}

class DropsDeterminism : public testing::TestWithParam<bool> {
 protected:
  ~DropsDeterminism() override { select_simd_target(""); }
};

TEST_P(DropsDeterminism, EveryTargetThreadCountOrderAndNumberOfDrops) {
  for (int count = 1; count <= 33; ++count) {
    auto start = test::random_drops(count, 8, 1.6e7f);
    // Close enough to touch.
    for (Drop& d : start) {
      for (float& x : d.position) x = 0.45f + 0.1f * x;
    }
    expect_one_result(fmt::format("{} drops", count),
                      [&](const parallel::Executor& executor) { return run(start, GetParam(), 3, executor); });
  }
}

TEST_P(DropsDeterminism, ManyChunks) {
  const auto start = test::random_drops(60000, 21, 3e4f);
  expect_one_result("60000 drops", [&](const parallel::Executor& executor) { return run(start, GetParam(), 4, executor); }, {1, 3});
  const parallel::Executor executor(1);
  EXPECT_NE(run(test::random_drops(60000, 22, 3e4f), GetParam(), 4, executor), run(start, GetParam(), 4, executor));
}

INSTANTIATE_TEST_SUITE_P(Drops, DropsDeterminism, testing::Bool(),
                         [](const auto& param) { return param.param ? "corrected" : "as_published"; });

}  // namespace
}  // namespace rainref::drops
