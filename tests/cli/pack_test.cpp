// `rainref pack`, and the captures of `rainref run`.
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "capture/manifest_write.h"
#include "capture/pack_read.h"
#include "cli/support.h"
#include "image_io/tiny_files.h"
#include "math/simd_target.h"
#include "shipped_packs.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class PackVerb : public CommandLine {
 protected:
  Outcome pack(const std::vector<std::string>& arguments) const { return good(copied(joined({"pack"}, arguments))); }
  capture::Pack read(const std::string& name) const { return capture::Pack(folder / name); }
  std::vector<std::string> ids(const std::string& name) const {
    std::vector<std::string> out;
    for (const capture::PackCase& c : read(name).cases) out.push_back(c.id);
    return out;
  }
  /// Every file with its bytes.
  std::map<std::string, std::string> files(const std::string& name) const {
    std::map<std::string, std::string> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / name)) {
      if (entry.is_regular_file()) out[std::filesystem::relative(entry.path(), folder / name)] = contents(entry.path());
    }
    return out;
  }
  /// The lines of `rainref hash`, from the outputs of a pack; substeps run into one hash.
  static std::vector<std::string> hash_lines(const capture::Pack& pack) {
    std::vector<std::string> names;
    std::map<std::string, Hasher> hashers;
    for (const capture::PackCase& entry : pack.cases) {
      const capture::PassCase c = pack.read(entry);
      for (const capture::CaseOutput& output : c.outputs) {
        const std::string name = fmt::format("{} {} {}", c.frame, c.pass, output.name);
        if (!hashers.contains(name)) names.push_back(name);
        hashers[name].add(output.array.levels[0]);
      }
    }
    std::vector<std::string> lines;
    for (const std::string& name : names) lines.push_back(fmt::format("{} {}", name, hashers[name].finish().text()));
    return lines;
  }
};

TEST_F(PackVerb, OutputsAreWhatHashHashes) {
  for (const std::string scene : {"corrected.toml", "published.toml"}) {
    pack({scene, "-o", "p", "--at", "0,1", "--set", "puddle.drop_intensity=3"});
    std::vector<std::string> expected = hash({scene, "--set", "puddle.drop_intensity=3"});
    expected.pop_back();
    EXPECT_EQ(hash_lines(read("p")), expected);
  }
}

TEST_F(PackVerb, FramesBeyondTheScenesOwnAreReached) {
  EXPECT_THAT(pack({"published.toml", "-o", "p", "--coverage"}).out, HasSubstr("shade exercises "));
  const Outcome o = pack({"published.toml", "-o", "p"});
  EXPECT_THAT(
      o.out,
      ContainsRegex("(^|\n)18 cases of raindrops wave_step surface_hit ground_noise shade display in [0-9]+ files, [0-9.]+ MiB, in p\n"));
  EXPECT_THAT(o.out, testing::Not(HasSubstr("exercises")));
  std::vector<std::string> expected = hash({"published.toml", "--frames", "13"}), found = hash_lines(read("p"));
  EXPECT_THAT(found, testing::IsSubsetOf(expected));
  EXPECT_EQ(found.size(), 3u * 7);
  EXPECT_THAT(ids("p"), testing::IsSupersetOf({"puddle.shade/0000.0", "puddle.shade/0001.0", "puddle.shade/0012.0"}));
}

TEST_F(PackVerb, OneCaseIsOne) {
  EXPECT_THAT(pack({"corrected.toml", "-o", "p", "--at", "0", "--passes", "display"}).out,
              ContainsRegex("1 case of display in [0-9]+ files, "));
  EXPECT_THAT(rainref({"diff", "p", "p"}).out, testing::StartsWith("equal: 1 run of a pass, 2 buffers\n"));
}

TEST_F(PackVerb, FramesAndPassesAreChosen) {
  pack({"corrected.toml", "-o", "p", "--at", "3,1,3", "--passes", "shade,wave_step"});
  EXPECT_THAT(ids("p"), ElementsAre("puddle.wave_step/0001.0", "puddle.wave_step/0001.1", "puddle.wave_step/0001.2",
                                    "puddle.wave_step/0001.3", "puddle.shade/0001.0", "puddle.wave_step/0003.0", "puddle.wave_step/0003.1",
                                    "puddle.wave_step/0003.2", "puddle.wave_step/0003.3", "puddle.shade/0003.0"));
}

// Pictures of frames that are not taken are not made; what they leave behind, streaks on their way and a fading mask, is.
TEST_F(PackVerb, AFrameIsTheSameWhicheverOthersAreTaken) {
  const std::string scene = rainref::test::pack_scene("windshield-trails").string();
  ASSERT_EQ(rainref({"pack", scene, "-o", "few", "--at", "6"}).code, 0);
  ASSERT_EQ(rainref({"pack", scene, "-o", "all", "--at", "0,1,2,3,4,5,6"}).code, 0);
  const std::vector<std::string> few = hash_lines(read("few"));
  EXPECT_GT(few.size(), 8u);
  EXPECT_THAT(few, testing::IsSubsetOf(hash_lines(read("all"))));
}

// A scene without wipers runs wipe_drops, which moves no drop: a port that copies its input would pass, so nothing is said of it, unless
// it is asked for by name.
TEST_F(PackVerb, APassThatDoesNothingInAnyFrameIsLeftOut) {
  put(folder / "dry.toml", R"(effect = "windshield"
variant = "corrected"
[run]
size = [32, 18]
frames = 2
[windshield]
height_size = [32, 20]
[wipers]
count = 0
[scene]
size = [32, 18]
)");
  const Outcome all = pack({"dry.toml", "-o", "all"});
  EXPECT_THAT(all.out, HasSubstr("left out: wipe_drops: a port that does nothing passes (a copy of its input drops), and no frame was "
                                 "found in which it does more\n"));
  EXPECT_THAT(all.out, testing::Not(HasSubstr("says nothing of wipe_drops")));
  const std::vector<std::string> cases = ids("all");
  EXPECT_FALSE(cases.empty());
  EXPECT_THAT(cases, testing::Not(testing::Contains(HasSubstr("wipe_drops"))));
  std::filesystem::copy(folder / "all", folder / "port", std::filesystem::copy_options::recursive);
  std::filesystem::remove(folder / "port/manifest.json");
  EXPECT_EQ(rainref({"validate", "all", "--port", "port", "--profile", "cuda", "--no-causes", "--exhaustive"}).code, 0);

  EXPECT_THAT(pack({"dry.toml", "--passes", "wipe_drops", "-o", "asked"}).out, HasSubstr("warning: this pack says nothing of wipe_drops"));
}
TEST_F(PackVerb, ThreadsAndSimdTargetsDoNotMatter) {
  const std::string basin = "puddle.shape=basin";  // the bed of a natural puddle costs most of a second
  pack({"corrected.toml", "-o", "p", "--at", "1", "--threads", "1", "--set", basin});
  const auto expected = files("p");
  for (const std::string& target : simd_targets()) {
    pack({"corrected.toml", "-o", "p", "--at", "1", "--threads", "3", "--simd", target, "--set", basin});
    EXPECT_EQ(files("p"), expected) << target;
  }
}

// What nobody knows before cannot be learned by heart; and the seed that is printed makes the pack again.
TEST_F(PackVerb, ARandomSeedIsPrintedAndMakesThePackAgain) {
  // So much rain that no seed leaves the first frames dry.
  const auto made = [&](const std::string& name, const std::string& seed) {
    return pack({"corrected.toml", "-o", name, "--at", "12", "--set", "rain.rate=60", "--passes", "wave_step,display", "--seed", seed}).out;
  };
  const auto seed_in = [&](const std::string& name) {
    return nlohmann::json::parse(contents(folder / name / "manifest.json"))["seed"].get<std::int64_t>();
  };
  const std::string said = made("a", "random");
  made("b", "random");
  const std::int64_t seed = seed_in("a");
  EXPECT_NE(seed, seed_in("b"));
  EXPECT_THAT(said, HasSubstr(fmt::format("seed {0}: --seed {0} makes this pack again\n", seed)));
  EXPECT_THAT(made("again", std::to_string(seed)), testing::Not(HasSubstr("seed")));
  EXPECT_EQ(files("again"), files("a"));
  EXPECT_NE(hash_lines(read("a")), hash_lines(read("b")));
  EXPECT_THAT(said, testing::Not(HasSubstr("no seed changes")));
  // It is the scene's key, which it overrides.
  pack({"corrected.toml", "-o", "set", "--at", "12", "--set", "rain.rate=60", "--passes", "wave_step,display", "--set",
        fmt::format("seed={}", seed)});
  EXPECT_EQ(hash_lines(read("set")), hash_lines(read("a")));
  pack({"corrected.toml", "-o", "both", "--at", "2", "--passes", "display", "--set", "seed=5", "--seed", "6"});
  EXPECT_EQ(seed_in("both"), 6);
}

// The article's drops are functions of time; masks of fixed geometry have no drops at all.
TEST_F(PackVerb, ARandomSeedNamesThePassesThatNoSeedChanges) {
  EXPECT_THAT(
      pack({"published.toml", "-o", "p", "--at", "1", "--passes", "wave_step,display", "--seed", "random"}).out,
      HasSubstr("warning: no seed changes what wave_step display gives: take other frames or keys, so that it cannot be known before\n"));
  EXPECT_THAT(pack({"published.toml", "-o", "p", "--at", "1", "--passes", "wave_step,display", "--seed", "5"}).out,
              testing::Not(HasSubstr("no seed changes")));
}

TEST_F(PackVerb, AnOlderPackIsReplacedAndNothingElse) {
  pack({"corrected.toml", "-o", "p", "--at", "0"});
  pack({"corrected.toml", "-o", "p", "--at", "1", "--passes", "display"});
  EXPECT_THAT(ids("p"), ElementsAre("puddle.display/0001.0"));
  put(folder / "p/mine.txt", "mine");
  before = folder.names();
  expect_refusal({"pack", "corrected.toml", "-o", "p"}, 4,
                 "cannot write 'p': the pack there would be replaced, but 'mine.txt' is no part of it");
  EXPECT_THAT(ids("p"), ElementsAre("puddle.display/0001.0"));
  std::filesystem::create_directory(folder / "d");
  put(folder / "d/mine.txt", "mine");
  before = folder.names();
  expect_refusal({"pack", "corrected.toml", "-o", "d"}, 4, "cannot write 'd': the folder is not empty and no pack of rainref");
  expect_refusal({"pack", "corrected.toml", "-o", "sky.png"}, 4, "cannot write 'sky.png': a file of that name exists");
}

TEST_F(PackVerb, BadArguments) {
  expect_refusal({"pack", "corrected.toml"}, 2, HasSubstr("--output is required"));
  expect_refusal({"pack", "-o", "p"}, 2, "expected one of SCENE, --spirv and --flat, found none");
  expect_refusal({"pack", "corrected.toml", "--spirv", "effect.json", "-o", "p"}, 2,
                 "expected one of SCENE, --spirv and --flat, found several");
  expect_refusal({"pack", "corrected.toml", "--inputs", "run", "-o", "p"}, 2, "--inputs: only beside --spirv");
  expect_refusal({"pack", "--spirv", "effect.json", "-o", "p"}, 2, "--inputs: expected the folder of a run, found ''");
  expect_refusal({"pack", "--spirv", "effect.json", "--inputs", "run", "-o", "p", "--at", "1"}, 2,
                 HasSubstr("--spirv: expected none of --at"));
  expect_refusal({"pack", "--spirv", "none.json", "--inputs", "run", "-o", "p"}, 4, HasSubstr("none.json"));
  expect_refusal({"pack", "corrected.toml", "-o", ""}, 2, "--output: expected a folder, found ''");
  expect_refusal({"pack", "corrected.toml", "-o", "p", "--frames", "3"}, 2, StartsWith("--frames: unknown option of 'pack'"));
  for (const auto& [at, found] : std::vector<std::pair<std::string, std::string>>{
           {"", ""}, {"1,", ""}, {"-1", "-1"}, {"1;2", "1;2"}, {"0,x", "x"}, {"1000001", "1000001"}}) {
    expect_refusal({"pack", "corrected.toml", "-o", "p", "--at", at}, 2,
                   fmt::format("--at: expected a whole number from 0 to 1000000, found '{}'", found));
  }
  expect_refusal({"pack", "corrected.toml", "-o", "p", "--passes", "wave_stp"}, 2,
                 "passes: expected some of raindrops, wave_step, surface_hit, shade, display, found 'wave_stp'; did you mean 'wave_step'?");
  expect_refusal({"pack", "corrected.toml", "-o", "p", "--passes", "ground_noise"}, 2,
                 HasSubstr("found 'ground_noise'"));  // as-published only
  expect_refusal({"pack", "corrected.toml", "-o", "p", "--passes", ""}, 2, EndsWith("found ''"));
  for (const std::string seed : {"", "-1", "1.5", "luck", "Random", "9223372036854775808"})
    expect_refusal({"pack", "corrected.toml", "-o", "p", "--seed", seed}, 2,
                   fmt::format("--seed: expected \"random\" or a whole number from 0 to 9223372036854775807, found '{}'", seed));
  expect_refusal({"pack", "--flat", "p", "-o", "q", "--seed", "random"}, 2, HasSubstr("--flat: expected none of --at, --passes, --seed"));
  expect_refusal({"pack", "none.toml", "-o", "p"}, 4, HasSubstr("none.toml"));
  expect_refusal({"pack", "corrected.toml", "-o", "p", "--set", "puddle.zebra=1"}, 2, HasSubstr("puddle.zebra"));
  expect_refusal({"pack", "corrected.toml", "-o", "p", "--set", "environment.image=none.png"}, 4, HasSubstr("none.png"));
}

TEST_F(PackVerb, ReasonsForWhatIsNotExercised) {
  put(folder / "reasons.toml",
      contents(folder / "corrected.toml") +
          "\n[unexercised]\nshade = [['shade.pass.h, shade_corrected: guarded refract, total reflection', 'mine'], ['none', 'x']]\n");
  before = folder.names();
  const Outcome o = pack({"reasons.toml", "-o", "p", "--at", "0"});
  EXPECT_THAT(o.out + o.err, HasSubstr("warning: unexercised.shade: 'none' is exercised, or there is none"));
  const auto manifest = nlohmann::json::parse(contents(folder / "p/manifest.json"));
  for (const nlohmann::json& pass : manifest["passes"])
    if (pass["name"] == "shade") {
      EXPECT_THAT(pass["coverage"]["reasons"].dump(), HasSubstr("\"mine\""));
      EXPECT_THAT(pass["coverage"]["never"].dump(), testing::Not(HasSubstr("total reflection")));
    }
  put(folder / "reasons.toml", contents(folder / "corrected.toml") + "\n[unexercised]\nshad = [['a', 'b']]\n");
  before = folder.names();
  expect_refusal({"pack", "reasons.toml", "-o", "q"}, 2,
                 "reasons.toml: unexercised.shad: expected a pass of this variant; did you mean 'shade'?");
}

TEST_F(PackVerb, ALossyInputIsRefused) {
  put(folder / "sky.jpg", image_io::jpeg(3));
  before = folder.names();
  expect_refusal(
      {"pack", "corrected.toml", "-o", "p", "--set", "environment.image=sky.jpg"}, 2,
      "environment.image: 'sky.jpg' is coded with loss, and machines may decode it differently; a pack takes PNG or losslessly coded EXR");
}

TEST_F(PackVerb, AFullDiskLeavesNothing) {
  Circumstances c;
  c.file_bytes = 2000;
  expect_refusal({"pack", "corrected.toml", "-o", "new/deep", "--at", "0"}, 4,
                 AllOf(StartsWith("cannot write 'new/deep/"), EndsWith("File too large")), c);
}

using RunCapture = PackVerb;

TEST_F(RunCapture, HoldsTheBuffersOfTheFramesThatAreWritten) {
  expect(copied({"run", "corrected.toml", "-o", "o", "--frames", "5", "--every", "2", "--capture", "all"}), 0,
         EndsWith(", 3 pictures, capture/ and summary.json in o\n"));
  pack({"corrected.toml", "-o", "p", "--at", "0,2,4", "--set", "run.frames=5"});
  // A capture is a pack, but that nobody counts what it exercises.
  std::map<std::string, std::string> packed = files("p");
  nlohmann::ordered_json manifest = nlohmann::ordered_json::parse(packed["manifest.json"]);
  for (nlohmann::ordered_json& pass : manifest["passes"]) pass.erase("coverage");
  packed["manifest.json"] = capture::manifest_text(manifest);
  EXPECT_EQ(files("o/capture"), packed);

  // The older run is replaced, its capture with it.
  expect(copied({"run", "corrected.toml", "-o", "o", "--overwrite", "--capture", "passes"}), 0);
  const capture::Pack outputs = read("o/capture");
  EXPECT_FALSE(outputs.with_inputs);
  EXPECT_THAT(hash_lines(outputs), testing::IsSubsetOf(hash({"corrected.toml"})));
  EXPECT_EQ(hash_lines(outputs).size(), 6u);  // the last frame
}

TEST_F(RunCapture, BadArguments) {
  expect_refusal({"run", "corrected.toml", "--capture", "pases"}, 2,
                 "--capture: expected passes or all, found 'pases'; did you mean 'passes'?");
  expect_refusal({"run", "corrected.toml", "--capture", ""}, 2, "--capture: expected passes or all, found ''");
  std::filesystem::create_directories(folder / "o/capture");
  put(folder / "o/capture/mine.txt", "mine");
  before = folder.names();
  expect_refusal({"run", "corrected.toml", "-o", "o", "--capture", "all"}, 4,
                 "cannot write 'o/capture': the folder is not empty and no pack of rainref");
}

}  // namespace
}  // namespace rainref::cli
