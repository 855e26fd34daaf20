// Every golden scene has the recorded hashes: all of its frames once, with a SIMD target and a number of threads that take turns from scene
// to scene; its first frames with every target. The tiles run in shuffled order.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "golden/recorded.h"
#include "golden/scenes.h"
#include "math/simd_target.h"

namespace rainref::golden {
namespace {

constexpr int thread_counts[] = {2, 1, 3, 8};

struct Turn {
  Scene scene;
  std::size_t number;
};
std::vector<Turn> turns_of(const std::string& effect) {
  std::vector<Turn> turns;
  for (const auto& [name, of_effect] : scenes()) {
    for (const Scene& scene : of_effect) {
      if (name == effect) turns.push_back({scene, turns.size()});
    }
  }
  return turns;
}

class Golden : public testing::TestWithParam<Turn> {
 protected:
  ~Golden() override { select_simd_target(""); }
};

TEST_P(Golden, HashesAreAsRecorded) {
  const auto& [scene, number] = GetParam();
  const std::vector<std::string> targets = simd_targets();
  for (std::size_t k = 0; k < targets.size(); ++k) {
    const int frames = k == 0 ? 60 : 3;
    const std::string& target = targets[(number + k) % targets.size()];
    const std::vector<std::string> expected = recorded(scene.name + " ", frames);
    ASSERT_FALSE(expected.empty()) << "no line of tests/golden/hashes.txt starts with " << scene.name;
    parallel::Executor executor(thread_counts[(number + k) % std::size(thread_counts)]);
    executor.shuffle_tiles(number + k);
    select_simd_target(target);
    // Line by line, so that the first pass that differs is the one named.
    const std::vector<std::string> found = scene.lines(executor, frames, call_plainly);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]) << target << ", " << executor.threads() << " threads";
  }
}

std::string name_of(const testing::TestParamInfo<Turn>& turn) {
  std::string name = turn.param.scene.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Puddle, Golden, testing::ValuesIn(turns_of("puddle")), name_of);
INSTANTIATE_TEST_SUITE_P(Windshield, Golden, testing::ValuesIn(turns_of("windshield")), name_of);
INSTANTIATE_TEST_SUITE_P(EdgeSplash, Golden, testing::ValuesIn(turns_of("edge_splash")), name_of);
INSTANTIATE_TEST_SUITE_P(ScreenDrops, Golden, testing::ValuesIn(turns_of("screen_drops")), name_of);
INSTANTIATE_TEST_SUITE_P(RainyGlass, Golden, testing::ValuesIn(turns_of("rainy_glass")), name_of);
INSTANTIATE_TEST_SUITE_P(NightStreet, Golden, testing::ValuesIn(turns_of("night_street")), name_of);

TEST(GoldenFile, EveryLineBelongsToAScene) {
  std::set<std::string> names;
  for (const auto& [effect, of_effect] : scenes()) {
    for (const Scene& scene : of_effect) names.insert(scene.name);
  }
  for (const std::string& line : recorded("")) EXPECT_TRUE(names.contains(line.substr(0, line.find(' ')))) << line;
}

}  // namespace
}  // namespace rainref::golden
