// Rays that are traced in batches each get their own hit.
#include "compositor/path_batches.h"

#include <gtest/gtest.h>

namespace rainref::compositor {
namespace {

TEST(PathBatches, EveryRayHasOneSlotAndItsOwnHit) {
  const Medium air_here, water_here;
  // Surfaces and media change at lengths that fill no vector, one vector, and more; some rays meet nothing.
  std::vector<Path> paths;
  std::vector<Hit> hits;
  for (std::uint32_t i = 0; i < 101; ++i) {
    Path path;
    path.medium = i % 5 < 3 ? &air_here : &water_here;
    paths.push_back(path);
    hits.push_back({1.0 + i, i % 7 == 6 ? Hit::none : i / 19, i, 0, 0});
  }
  PathBatches batches;
  for (const std::size_t n : {paths.size(), std::size_t{0}, std::size_t{1}, std::size_t{17}}) {
    batches.sort(std::span(paths).first(n), std::span(hits).first(n));
    std::vector<int> times(n, 0);
    std::size_t begin = 0;
    for (const PathBatches::Batch& batch : batches.batches()) {
      EXPECT_EQ(batch.begin, begin);
      for (std::size_t slot = begin; slot < begin + whole_lanes(batch.count); ++slot) {
        const std::size_t last = begin + batch.count - 1, source = std::min(slot, last);
        ASSERT_EQ(batches.ray()[slot], batches.ray()[source]);
        const std::uint32_t ray = batches.ray()[slot];
        ASSERT_EQ(batches.hit()[slot].part, hits[ray].part);
        ASSERT_TRUE(batch.is(hits[ray].surface, hits[ray].is_surface() ? paths[ray].medium : nullptr));
        if (slot > last) continue;
        EXPECT_EQ(batches.slot(ray), slot);
        ++times[ray];
        if (slot > begin) {
          EXPECT_LT(batches.ray()[slot - 1], ray);  // lanes load runs of neighbours by this
        }
      }
      begin += whole_lanes(batch.count);
    }
    EXPECT_EQ(batches.slots(), begin);
    EXPECT_EQ(batches.batches().front().surface, Hit::none);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(times[i], 1) << i;
  }
}

}  // namespace
}  // namespace rainref::compositor
