// `rainref run`: what it writes, and where.
#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "math/simd_target.h"
#include "image_io/read.h"

namespace rainref::cli {
namespace {

using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::MatchesRegex;

class RunVerb : public CommandLine {
 protected:
  Outcome run(const std::vector<std::string>& arguments) const { return good(rainref(joined({"run"}, arguments))); }
  nlohmann::json summary(const std::string& in) const { return nlohmann::json::parse(contents(folder / (in + "/summary.json"))); }
};

TEST_F(RunVerb, WritesTheLastFrameAndASummary) {
  const Outcome o = run({"corrected.toml", "-o", "a/b"});
  EXPECT_THAT(o.out, MatchesRegex("2 frames in [^\n]*, 1 picture and summary\\.json in a/b\n"));
  EXPECT_THAT(names("a/b"), ElementsAre("puddle.0001.png", "summary.json"));
  const image_io::Picture picture = image_io::read(folder / "a/b/puddle.0001.png");
  EXPECT_EQ(picture.image.width(), 24);
  EXPECT_EQ(picture.image.height(), 16);
  EXPECT_THAT(picture.channel_names, ElementsAre("R", "G", "B"));
}

TEST_F(RunVerb, OneFrameIsOne) {
  EXPECT_THAT(run({"corrected.toml", "-o", "o", "--frames", "1"}).out,
              MatchesRegex("1 frame in [^\n]*, 1 picture and summary\\.json in o\n"));
}

TEST_F(RunVerb, KindsOfPictures) {
  run({"corrected.toml", "-o", "exr", "--image", "exr"});
  EXPECT_THAT(names("exr"), ElementsAre("puddle.0001.exr", "summary.json"));
  run({"published.toml", "-o", "both", "--image", "both"});
  EXPECT_THAT(names("both"), ElementsAre("puddle.0001.exr", "puddle.0001.png", "summary.json"));
  EXPECT_THAT(run({"corrected.toml", "-o", "none", "--image", "none"}).out, MatchesRegex(".*, 0 pictures and summary\\.json in none\n"));
  EXPECT_THAT(names("none"), ElementsAre("summary.json"));
  const image_io::Picture exr = image_io::read(folder / "exr/puddle.0001.exr");
  EXPECT_EQ(exr.image.format(), Format::rgba16f);
  EXPECT_THAT(exr.channel_names,
              IsSupersetOf({"R", "G", "B", "normal.X", "normal.Y", "normal.Z", "position.X", "position.Y", "position.Z"}));
  EXPECT_FALSE(exr.lossy);
}

TEST_F(RunVerb, EveryKthFrame) {
  run({"corrected.toml", "-o", "o", "--frames", "5", "--every", "2"});
  EXPECT_THAT(names("o"), ElementsAre("puddle.0000.png", "puddle.0002.png", "puddle.0004.png", "summary.json"));
  run({"corrected.toml", "-o", "p", "--frames", "5"});
  EXPECT_EQ(contents(folder / "o/puddle.0004.png"), contents(folder / "p/puddle.0004.png"));
  const nlohmann::json s = summary("p");
  EXPECT_GT(s["ms_per_frame"].get<double>(), 0);
  EXPECT_LT(s["ms_per_frame"].get<double>() * 3, s["seconds"].get<double>() * 1e3) << "without the first and the last";
  // It ran, wrote no picture and said nothing.
  before = folder.names();
  expect_refusal({"run", "corrected.toml", "-o", "q", "--frames", "3", "--first", "1", "--every", "3"}, 2,
                 "--every: expected a frame to show, found none from 1 to 2 that 3 divides");
}

TEST_F(RunVerb, TheSummaryHoldsConfigurationHashesAndTimes) {
  run({"corrected.toml", "-o", "o", "--set", "rain.rate=40", "--threads", "2", "--simd", simd_targets().back()});
  const nlohmann::json s = summary("o");
  EXPECT_EQ(s["config"]["rain.rate"], 40.0);
  EXPECT_EQ(s["config"]["run.size"], (std::vector<int>{24, 16}));
  EXPECT_EQ(s["origins"]["rain.rate"], "--set");
  EXPECT_EQ(s["origins"]["run.frames"], "corrected.toml:4:1");
  EXPECT_EQ(s["threads"], 2);
  EXPECT_EQ(s["simd"], simd_targets().back());
  EXPECT_EQ(s["frames"], 2);
  EXPECT_GT(s["seconds"].get<double>(), 0);
  EXPECT_FALSE(s.contains("ms_per_frame")) << "of two frames";
  EXPECT_EQ(s["inputs"][0]["key"], "environment.image");
  EXPECT_EQ(s["inputs"][0]["file"], "sky.npy");
  EXPECT_EQ(s["inputs"][0]["lossy"], false);
  EXPECT_EQ(s["inputs"][0]["decoded_hash"], image_io::read(folder / "sky.png").decoded_hash.text());
  std::vector<std::string> passes;
  for (const auto& pass : s["passes"]) {
    passes.push_back(pass["name"]);
    EXPECT_GE(pass["ms_per_frame"].get<double>(), 0);
    EXPECT_EQ(pass["calls"], passes.size() <= 2 ? 8 : 2);  // four steps in a frame
  }
  EXPECT_THAT(passes, ElementsAre("raindrops", "wave_step", "surface_hit", "shade", "display"));
  const std::vector<std::string> lines = hash({"corrected.toml", "--set", "rain.rate=40"});
  ASSERT_EQ(s["last_frame"].size(), 6u);
  for (int i = 0; i < 6; ++i) {
    const auto& line = s["last_frame"][i];
    EXPECT_EQ(fmt::format("{} {} {} {}", line["frame"].get<int>(), line["pass"].get<std::string>(), line["buffer"].get<std::string>(),
                          line["xxh3"].get<std::string>()),
              lines[static_cast<std::size_t>(6 + i)]);
  }
}

TEST_F(RunVerb, JsonGoesToStandardOutput) {
  const Outcome o = run({"corrected.toml", "-o", "o", "--json"});
  EXPECT_EQ(o.out, contents(folder / "o/summary.json"));
}

TEST_F(RunVerb, TheDefaultFolderIsNamedByEffectAndScene) {
  run({"corrected.toml"});
  EXPECT_THAT(names("out/puddle/corrected"), ElementsAre("puddle.0001.png", "summary.json"));
}

TEST_F(RunVerb, TwiceGivesTheSameBytes) {
  run({"corrected.toml", "-o", "a", "--image", "both", "--threads", "1"});
  run({"corrected.toml", "-o", "b", "--image", "both", "--threads", "3"});
  for (const std::string name : {"puddle.0001.png", "puddle.0001.exr"}) {
    EXPECT_NE(contents(folder / ("a/" + name)), "");
    EXPECT_EQ(contents(folder / ("a/" + name)), contents(folder / ("b/" + name)));
  }
}

TEST_F(RunVerb, AnExistingFolderKeepsWhatElseIsInIt) {
  std::filesystem::create_directory(folder / "o");
  put(folder / "o/puddle.0001.png", "old");
  put(folder / "o/mine.txt", "mine");
  run({"corrected.toml", "-o", "o"});
  EXPECT_THAT(names("o"), ElementsAre("mine.txt", "puddle.0001.png", "summary.json"));
  EXPECT_EQ(contents(folder / "o/mine.txt"), "mine");
  EXPECT_EQ(image_io::read(folder / "o/puddle.0001.png").image.width(), 24);
}

// Pictures of two runs under one summary told a film that never was.
TEST_F(RunVerb, ResultsOfTwoRunsDoNotStandBesideEachOther) {
  const std::vector<std::string> film{"corrected.toml", "-o", "o", "--frames", "5", "--every", "1"};
  run(film);
  const std::string last = contents(folder / "o/puddle.0004.png");
  put(folder / "o/mine.txt", "mine");
  put(folder / "o/puddle.0007.png", "mine, whatever it is called");
  const auto o_holds = names("o");
  // The same again, as often as one likes, of a scene that was edited meanwhile too.
  run(film);
  EXPECT_EQ(names("o"), o_holds);
  EXPECT_EQ(contents(folder / "o/puddle.0004.png"), last);
  run({"corrected.toml", "-o", "o", "--frames", "5", "--every", "1", "--set", "rain.rate=40"});
  EXPECT_EQ(names("o"), o_holds);
  // Others: nothing is written, and nothing goes.
  before = folder.names();
  const std::string kept = contents(folder / "o/summary.json");
  put(folder / "other.toml", "effect = 'windshield'\nvariant = 'corrected'\n");
  before = folder.names();
  const std::vector<std::vector<std::string>> others{{"corrected.toml", "--frames", "3"},
                                                     {"corrected.toml", "--frames", "5", "--first", "2", "--every", "1"},
                                                     {"corrected.toml", "--frames", "5", "--image", "none"},
                                                     {"corrected.toml", "--frames", "5", "--every", "1", "--image", "exr"},
                                                     {"other.toml", "--frames", "5", "--every", "1"}};
  for (const std::vector<std::string>& other : others) {
    expect_refusal(joined({"run", "-o", "o"}, other), 2, testing::HasSubstr("that this run does not write, such as puddle.000"));
    EXPECT_EQ(names("o"), o_holds);
    EXPECT_EQ(contents(folder / "o/summary.json"), kept);
  }
  expect_refusal(
      {"run", "corrected.toml", "-o", "o", "--frames", "2"}, 2,
      "o: expected no other run's results, found 4 pictures that this run does not write, such as puddle.0000.png: --overwrite removes "
      "what that run left, -o names another folder");
  run({"corrected.toml", "-o", "o", "--frames", "2", "--overwrite"});
  EXPECT_THAT(names("o"), ElementsAre("mine.txt", "puddle.0001.png", "puddle.0007.png", "summary.json"));
  EXPECT_EQ(contents(folder / "o/puddle.0007.png"), "mine, whatever it is called");
  // Captures and comparisons are results too.
  run({"corrected.toml", "-o", "o", "--frames", "2", "--capture", "passes", "--compare-truth", "--image", "both"});
  before = folder.names();
  expect_refusal({"run", "corrected.toml", "-o", "o", "--frames", "2", "--image", "both"}, 2,
                 testing::HasSubstr("such as puddle.0001.truth."));
  run({"corrected.toml", "-o", "o", "--frames", "2", "--capture", "passes", "--overwrite"});
  EXPECT_THAT(names("o"), ElementsAre("capture", "mine.txt", "puddle.0001.png", "puddle.0007.png", "summary.json"));
  before = folder.names();
  expect_refusal({"run", "corrected.toml", "-o", "o", "--frames", "2"}, 2, testing::HasSubstr("found capture/: --overwrite"));
  put(folder / "o/capture/notes.txt", "mine");
  expect_refusal({"run", "corrected.toml", "-o", "o", "--frames", "2", "--overwrite"}, 2,
                 testing::HasSubstr("found 'notes.txt' beside it"));
  std::filesystem::remove(folder / "o/capture/notes.txt");
  run({"corrected.toml", "-o", "o", "--frames", "2", "--overwrite"});
  EXPECT_THAT(names("o"), ElementsAre("mine.txt", "puddle.0001.png", "puddle.0007.png", "summary.json"));
}

// One look at a scene after another, in the folder that rainref chooses; the pictures of a film do not go without a word.
TEST_F(RunVerb, InTheDefaultFolderOnePictureGivesWayToTheNext) {
  run({"corrected.toml"});
  run({"corrected.toml", "--frames", "4"});
  EXPECT_THAT(names("out/puddle/corrected"), ElementsAre("puddle.0003.png", "summary.json"));
  run({"corrected.toml", "--frames", "3", "--every", "1"});
  before = folder.names();
  expect_refusal({"run", "corrected.toml", "--frames", "4"}, 2, testing::HasSubstr("found 3 pictures that this run does not write"));
  EXPECT_THAT(names("out/puddle/corrected"), ElementsAre("puddle.0000.png", "puddle.0001.png", "puddle.0002.png", "summary.json"));
}

TEST_F(RunVerb, TheSummaryIsASceneThatGivesTheSame) {
  run({"corrected.toml", "-o", "o"});
  std::string text;
  const nlohmann::json s = summary("o");
  for (const auto& [key, value] : s["config"].items()) text += key + " = " + value.dump() + "\n";
  put(folder / "again.toml", text);
  EXPECT_EQ(hash({"again.toml"}), hash({"corrected.toml"}));
}

TEST_F(RunVerb, AFileNameThatIsNoUtf8Runs) {
  std::filesystem::rename(folder / "corrected.toml", folder / "\xff.toml");
  run({"\xff.toml", "-o", "o"});
  EXPECT_EQ(summary("o")["origins"]["effect"], "\uFFFD.toml:1:1");
}

}  // namespace
}  // namespace rainref::cli
