// `rainref hash`.
#include "cli/support.h"
#include "math/simd_target.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::MatchesRegex;

using HashVerb = CommandLine;

std::vector<std::string> without_hashes(const std::vector<std::string>& lines) {
  std::vector<std::string> out;
  for (const std::string& line : lines) out.push_back(line.substr(0, line.rfind(' ')));
  return out;
}

TEST_F(HashVerb, OneLineForEachFramePassAndBuffer) {
  const std::vector<std::string> lines = hash({"corrected.toml"});
  EXPECT_THAT(lines, Each(MatchesRegex(".* [0-9a-f]{32}")));
  EXPECT_THAT(without_hashes(lines),
              ElementsAre("0 raindrops drops", "0 wave_step wave", "0 surface_hit hit", "0 surface_hit normal", "0 shade colour",
                          "0 display picture", "1 raindrops drops", "1 wave_step wave", "1 surface_hit hit", "1 surface_hit normal",
                          "1 shade colour", "1 display picture", "scene"));
  EXPECT_THAT(without_hashes(hash({"published.toml", "--frames", "1"})),
              ElementsAre("0 raindrops drops", "0 wave_step wave", "0 surface_hit hit", "0 surface_hit normal", "0 ground_noise noise",
                          "0 shade colour", "0 display picture", "scene"));
}

class HashVerbOn : public CommandLine, public testing::WithParamInterface<std::string> {};

// In heavy rain, where drops fall beside cells at rest.
TEST_P(HashVerbOn, ThreadsAndSimdTargetsDoNotMatter) {
  const std::vector<std::vector<std::string>> scenes{{"published.toml", "--set", "puddle.rain_speed=20"},
                                                     {"corrected.toml", "--set", "rain.rate=40"}};
  for (const std::vector<std::string>& scene : scenes) {
    std::vector<std::string> arguments = scene;
    const std::vector<std::string> expected = hash(arguments);
    arguments.insert(arguments.end(), {"--simd", GetParam(), "--threads", ""});
    for (const std::string threads : {"1", "2", "3", "8"}) {
      arguments.back() = threads;
      EXPECT_EQ(hash(arguments), expected) << scene.front() << " with " << threads << " threads";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EachSimdTarget, HashVerbOn, testing::ValuesIn(simd_targets()), [](const auto& tested) { return tested.param; });

TEST_F(HashVerb, FramesTakeEffect) {
  const std::vector<std::string> two = hash({"corrected.toml"}), three = hash({"corrected.toml", "--frames", "3"});
  ASSERT_EQ(three.size(), 3u * 6 + 1);
  EXPECT_EQ(std::vector(two.begin(), two.end() - 1), std::vector(three.begin(), three.begin() + 12));  // a longer run starts alike
  EXPECT_NE(two.back(), three.back());
}

TEST_F(HashVerb, SizeTakesEffect) {
  const std::vector<std::string> small = hash({"corrected.toml"}), large = hash({"corrected.toml", "--size", "25x16"});
  EXPECT_EQ(small[1], large[1]);  // the wave has a grid of its own
  EXPECT_NE(small[2], large[2]);
  EXPECT_EQ(hash({"corrected.toml", "--size", "24x16"}), small);
  EXPECT_EQ(hash({"corrected.toml", "--set", "run.size=[25, 16]"}), large);
}

TEST_F(HashVerb, SetTakesEffectAndTheLastOneWins) {
  const std::vector<std::string> plain = hash({"corrected.toml"});
  EXPECT_NE(hash({"corrected.toml", "--set", "seed=5"}).back(), plain.back());
  EXPECT_NE(hash({"corrected.toml", "--set", "display.exposure=2"})[5], plain[5]);
  EXPECT_EQ(hash({"corrected.toml", "--set", "display.exposure=2"})[4], plain[4]);
  EXPECT_EQ(hash({"corrected.toml", "--set", "seed=5", "--set", "seed=0"}), plain);
  EXPECT_EQ(hash({"corrected.toml", "--set", "run.frames=9", "--frames", "2"}), plain);
  EXPECT_EQ(hash({"published.toml", "--set", "variant=corrected", "--set", "puddle.grid=[40,30]", "--set", "puddle.cell_size=0.02"}),
            plain);
}

TEST_F(HashVerb, WritesNoFile) {
  hash({"corrected.toml"});
  EXPECT_EQ(folder.names(), before);
}

TEST_F(HashVerb, AFileOfTheSceneLiesBesideItOneOfTheCommandLineWhereTheUserStands) {
  const std::vector<std::string> plain = hash({"corrected.toml"});
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::rename(folder / "corrected.toml", folder / "sub/corrected.toml");
  std::filesystem::copy(folder / "sky.npy", folder / "sub/sky.npy");
  std::filesystem::rename(folder / "sky.npy", folder / "mine.npy");
  EXPECT_EQ(hash({"sub/corrected.toml"}), plain);
  EXPECT_EQ(hash({"sub/corrected.toml", "--set", "environment.image=mine.npy"}), plain);
}

// Without a picture the surroundings are made here; the one test that pays for them.
TEST_F(HashVerb, ASceneNeedsNoAsset) {
  const std::vector<std::string> lines =
      hash({rainref::test::source_folder() + "/scenes/puddle/default.toml", "--frames", "1", "--size", "24x16"});
  EXPECT_EQ(lines.size(), 7u);
}

TEST_F(HashVerb, SelftestPasses) {
  const Outcome o = rainref({"selftest"});
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_THAT(lines_of(o.out).back(), "selftest passed");
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace rainref::cli
