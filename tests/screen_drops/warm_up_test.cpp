// A warm-up that was kept by another run is the one that this run would have made.
#include <gtest/gtest.h>

#include "base/temporary_folder.h"
#include "cache/kept_images.h"
#include "cache/program.h"
#include "screen_drops/flow_support.h"

namespace rainref::screen_drops {
namespace {

using namespace test;

class KeptWarmUp : public testing::Test {
 protected:
  ~KeptWarmUp() override { cache::keep_in({}); }
  std::ptrdiff_t files() const {
    return std::filesystem::exists(folder / "kept") ? std::distance(std::filesystem::directory_iterator(folder / "kept"), {}) : 0;
  }
  TemporaryFolder folder;
  parallel::Executor executor{2};
};

struct Ran {
  std::string drops, height, film;
  drops::MassBalance balance;
  std::int64_t residual;
  bool operator==(const Ran&) const = default;
};
Ran ran(const FlowSettings& s, const parallel::Executor& executor) {
  Flow flow(s, executor);
  for (int n = 0; n < 5; ++n) flow.simulate();
  return {bytes_of(flow.drops()), bytes_of(flow.height()), bytes_of(flow.film()), flow.mass_balance(), flow.residual()};
}

TEST_F(KeptWarmUp, GoesOnAsTheOneThatWasMade) {
  FlowSettings wet = wet_pane();
  wet.warm_up = 80 / wet.fps;
  const auto with = [&](const auto& change) {
    FlowSettings s = wet;
    change(s);
    return s;
  };
  const FlowSettings all[] = {wet,
                              with([](FlowSettings& s) { s.warm_up *= 2; }),
                              with([](FlowSettings& s) { s.substeps = 2; }),
                              with([](FlowSettings& s) { s.pane[0] *= 1.5; }),
                              with([](FlowSettings& s) { s.wind = 5; }),
                              with([](FlowSettings& s) { s.splat.width *= 2; }),
                              with([](FlowSettings& s) { ++s.drops.seed; }),
                              with([](FlowSettings& s) { s.drops.humidity = 0.5; }),
                              with([](FlowSettings& s) { s.drops.rain_rate *= 3; }),
                              with([](FlowSettings& s) { s.drops.film_drying *= 3; })};
  std::vector<Ran> made;
  for (const FlowSettings& s : all) made.push_back(ran(s, executor));
  cache::keep_in(folder / "kept");
  for (int go = 0; go < 2; ++go) {  // made and kept, then read
    for (std::size_t i = 0; i < std::size(all); ++i) EXPECT_EQ(ran(all[i], executor), made[i]) << go << ' ' << i;
    // WebAssembly does not say which program it is, and keeps nothing.
    EXPECT_EQ(files(), cache::program_hash() ? std::ssize(all) : 0);
  }
  for (std::size_t i = 1; i < made.size(); ++i) EXPECT_NE(made[i], made[0]) << i;
}

}  // namespace
}  // namespace rainref::screen_drops
