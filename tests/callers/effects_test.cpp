// The bits of every effect are those of tests/golden/hashes.txt whatever floating-point state the caller is in, before it opens an
// effect and after; and the caller's state is its own again after each call.
#include <gtest/gtest.h>

#include "callers/states.h"
#include "golden/recorded.h"
#include "golden/scenes.h"

namespace rainref {
namespace {

using test::CalledIn;
using test::CallerState;

constexpr int frames = 2;

void expect_the_same_bits(const golden::Scene& scene, const CallerState& state, bool from_the_start) {
  SCOPED_TRACE(scene.name + ", " + state.name + (from_the_start ? ", before opening" : ", after opening"));
  const std::vector<std::string> expected = golden::recorded(scene.name + " ", frames);
  ASSERT_FALSE(expected.empty());
  CalledIn called(state);
  int calls = 0;
  const std::vector<std::string> found = scene.lines(parallel::Executor(2), frames, [&](const std::function<void()>& call) {
    if (calls++ == 0 && !from_the_start) return call();
    called(call);
  });
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(called.kept());
  EXPECT_GE(calls, 1 + frames);
}

/// Of each variant a scene: every state with the corrected one, what moves the most bits and what ends a process with the published one.
void expect_the_same_bits(const std::vector<golden::Scene>& scenes) {
  const auto is_corrected = [](const golden::Scene& s) { return s.name.find("/corrected") != std::string::npos; };
  const auto is_published = [](const golden::Scene& s) { return s.name.find("/as-published") != std::string::npos; };
  const auto corrected = std::find_if(scenes.rbegin(), scenes.rend(), is_corrected);  // the last has most: flow, substeps, a probe
  const auto published = std::find_if(scenes.begin(), scenes.end(), is_published);
  ASSERT_TRUE(corrected != scenes.rend() && published != scenes.end()) << "no golden scene of a variant";
  for (const CallerState& state : test::decisive_states()) {
    for (const bool from_the_start : {true, false}) expect_the_same_bits(*corrected, state, from_the_start);
  }
  expect_the_same_bits(*published, test::toward_zero(), true);
  expect_the_same_bits(*published, test::decisive_states().back(), true);
}

TEST(AnyCaller, EveryEffect) {
  for (const auto& [name, scenes] : golden::scenes()) {
    if (name != "compositor" && name != "night_street") expect_the_same_bits(scenes);
  }
}

}  // namespace
}  // namespace rainref
