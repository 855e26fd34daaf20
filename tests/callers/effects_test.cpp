// The bits of every effect are those of tests/golden/hashes.txt whatever floating-point state the caller is in, before it opens an
// effect and after; and the caller's state is its own again after each call.
#include <gtest/gtest.h>

#include "callers/states.h"
#include "edge_splash/golden_scenes.h"
#include "golden/golden_check.h"
#include "puddle/golden_scenes.h"
#include "rainy_glass/golden_scenes.h"
#include "screen_drops/golden_scenes.h"
#include "windshield/golden_scenes.h"

namespace rainref {
namespace {

using test::CalledIn;
using test::CallerState;

constexpr int frames = 2;

/// The recorded lines of frames 0 and 1.
std::vector<std::string> expected_lines(const std::string& scene) {
  std::vector<std::string> lines;
  for (std::string& line : golden::recorded(scene + " ")) {
    const int frame = std::stoi(line.substr(scene.size() + 1));
    if (frame < frames) lines.push_back(std::move(line));
  }
  return lines;
}

template <class Scene>
void expect_the_same_bits(const Scene& scene, const CallerState& state, bool from_the_start) {
  SCOPED_TRACE(scene.name + ", " + state.name + (from_the_start ? ", before opening" : ", after opening"));
  const std::vector<std::string> expected = expected_lines(scene.name);
  ASSERT_FALSE(expected.empty());
  CalledIn called(state);
  int calls = 0;
  const std::vector<std::string> found = golden_lines(scene, parallel::Executor(2), frames, [&](const std::function<void()>& call) {
    if (calls++ == 0 && !from_the_start) return call();
    called(call);
  });
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(called.kept());
  EXPECT_GE(calls, 1 + frames);
}

/// Of each variant a scene: every state with the corrected one, what moves the most bits and what ends a process with the published one.
template <class Scene>
void expect_the_same_bits(const std::vector<Scene>& scenes) {
  const auto is_corrected = [](const Scene& s) { return s.name.find("/corrected") != std::string::npos; };
  const auto is_published = [](const Scene& s) { return s.name.find("/as-published") != std::string::npos; };
  const auto corrected = std::find_if(scenes.rbegin(), scenes.rend(), is_corrected);  // the last has most: flow, substeps, a probe
  const auto published = std::find_if(scenes.begin(), scenes.end(), is_published);
  ASSERT_TRUE(corrected != scenes.rend() && published != scenes.end()) << "no golden scene of a variant";
  for (const CallerState& state : test::decisive_states()) {
    for (const bool from_the_start : {true, false}) expect_the_same_bits(*corrected, state, from_the_start);
  }
  expect_the_same_bits(*published, test::toward_zero(), true);
  expect_the_same_bits(*published, test::decisive_states().back(), true);
}

TEST(AnyCaller, Puddle) { expect_the_same_bits(puddle::golden_scenes()); }
TEST(AnyCaller, Windshield) { expect_the_same_bits(windshield::golden_scenes()); }
TEST(AnyCaller, EdgeSplash) { expect_the_same_bits(edge_splash::golden_scenes()); }
TEST(AnyCaller, ScreenDrops) { expect_the_same_bits(screen_drops::golden_scenes()); }
TEST(AnyCaller, RainyGlass) { expect_the_same_bits(rainy_glass::golden_scenes()); }

}  // namespace
}  // namespace rainref
