// Packs that a program writes, and folders of ports that it judges: what the command line writes and says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "callers/states.h"
#include "capture/pack_read.h"
#include "rainref/error.h"
#include "rainref/judging.h"
#include "shipped_packs.h"
#include "simulation/small_scenes.h"

namespace rainref {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const parallel::Executor executor(2);

std::map<std::string, std::string> files(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) all[fs::relative(entry.path(), folder)] = contents(entry.path());
  return all;
}
/// The outputs of a pack, without the manifest and the inputs.
std::map<std::string, std::string> outputs(const fs::path& folder) {
  std::map<std::string, std::string> all = files(folder);
  std::erase_if(all, [](const auto& file) { return file.first.find("/out.") == std::string::npos; });
  return all;
}
SceneText rain() { return small("puddle", "corrected"); }

TEST(WrittenPacks, HoldWhatTheSimulationGives) {
  const TemporaryFolder folder;
  std::vector<int> told;
  const PackSummary made =
      write_pack(rain(), folder / "p", executor, {.frames = {2, 0}, .passes = {"display", "wave_step"}, .progress = [&](int done, int of) {
                                                    EXPECT_EQ(of, 3);
                                                    told.push_back(done);
                                                  }});
  EXPECT_THAT(told, ElementsAre(1, 2, 3));
  EXPECT_THAT(made.passes, ElementsAre("wave_step", "display"));
  EXPECT_EQ(made.seed, 0);
  const Cases read(folder / "p");
  EXPECT_EQ(read.size(), static_cast<std::size_t>(made.cases));
  Simulation sim(rain(), executor);
  Cases cases(sim);
  for (int frame = 0; frame < 3; ++frame) cases.add_next_frame(sim, {"display", "wave_step"});
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < cases.size(); ++i) by_id[cases.info(i).id] = i;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const CaseInfo about = read.info(i);
    EXPECT_NE(about.frame, 1);
    const CaseArray ours = read.expected(i, about.outputs[0]), theirs = cases.expected(by_id.at(about.id), about.outputs[0]);
    EXPECT_TRUE(std::ranges::equal(ours.bytes, theirs.bytes)) << about.id;
  }
}

// What nobody knows before cannot be learned by heart; and the seed that is told makes the pack again.
TEST(WrittenPacks, OfARandomSeedDifferAndAreMadeAgainByTheirSeed) {
  const TemporaryFolder folder;
  const auto made = [&](const char* name, const std::string& seed) {
    return write_pack(rain(), folder / name, executor, {.frames = {12}, .passes = {"wave_step", "display"}, .seed = seed}).seed;
  };
  const std::int64_t a = made("a", "random"), b = made("b", "random");
  EXPECT_NE(a, b);
  EXPECT_GE(std::min(a, b), 0);
  EXPECT_LT(std::max(a, b), std::int64_t{1} << 53);
  const auto of_a = outputs(folder / "a"), of_b = outputs(folder / "b");
  ASSERT_EQ(of_a.size(), of_b.size());
  for (const auto& [file, bytes] : of_a) EXPECT_NE(bytes, of_b.at(file)) << file;
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "a/manifest.json"))["seed"], a);
  EXPECT_EQ(made("again", std::to_string(a)), a);
  EXPECT_EQ(files(folder / "again"), files(folder / "a"));
}

TEST(WrittenPacks, AreOfTheSceneAsItIsNow) {
  const TemporaryFolder folder;
  Simulation sim(rain(), executor);
  sim.next_frame();
  sim.set("seed", "41");
  EXPECT_EQ(write_pack(sim.scene_text(), folder / "p", executor, {.frames = {1}, .passes = {"wave_step"}}).seed, 41);
  EXPECT_EQ(sim.frame(), 1);
  SceneText with = rain();
  with.set.push_back("seed=41");
  write_pack(with, folder / "q", executor, {.frames = {1}, .passes = {"wave_step"}});
  EXPECT_EQ(outputs(folder / "p"), outputs(folder / "q"));
}

TEST(WrittenPacks, AreTheSameInEveryFloatingPointState) {
  const TemporaryFolder folder;
  const SceneText scene = rain();
  const PackOptions options{.frames = {0}, .passes = {"wave_step", "display"}};
  const fs::path place = folder / "p";
  const auto make = [&] { write_pack(scene, place, executor, options); };
  make();
  const auto expected = files(place);
  for (const test::CallerState& state : test::decisive_states()) {
    test::CalledIn called(state);
    called(make);
    EXPECT_EQ(files(place), expected) << state.name;
    EXPECT_TRUE(called.kept()) << state.name;
  }
}

TEST(WrittenPacks, SayWhatTheyLeaveOut) {
  const TemporaryFolder folder;
  const PackSummary dry = write_pack(small("windshield", "corrected", {"wipers.count=0", "run.frames=2"}), folder / "p", executor);
  EXPECT_THAT(dry.notes, Contains("left out: falling_rain does not run in the first 13 frames"));
  EXPECT_THAT(dry.passes, testing::Not(Contains("falling_rain")));
}

TEST(WrittenPacks, AreWholeOrNotThere) {
  const TemporaryFolder folder;
  const auto refused = [&](const SceneText& scene, const PackOptions& options) {
    const std::string error = error_of([&] { write_pack(scene, folder / "p", executor, options); });
    EXPECT_FALSE(fs::exists(folder / "p"));
    return error;
  };
  EXPECT_EQ(refused(rain(), {.seed = "luck"}), "2 seed: expected \"random\" or a whole number from 0 to 9223372036854775807, found 'luck'");
  for (const char* seed : {"-1", "1.5", "9223372036854775808", " 1", "Random"})
    EXPECT_THAT(refused(rain(), {.seed = seed}), HasSubstr(seed));
  EXPECT_EQ(refused(rain(), {.frames = {3, -1}}), "2 frames: expected 0 or more, found -1");
  EXPECT_THAT(refused(rain(), {.passes = {"displya"}}), HasSubstr("did you mean 'display'?"));
  EXPECT_THAT(refused(small("pudle", "corrected"), {}), HasSubstr("did you mean 'puddle'?"));
  struct Stopped {};
  EXPECT_THROW(write_pack(rain(), folder / "p", executor,
                          {.frames = {2},
                           .progress =
                               [](int done, int) {
                                 if (done == 2) throw Stopped();
                               }}),
               Stopped);
  EXPECT_FALSE(fs::exists(folder / "p"));
}

TEST(FoldersOfPorts, AreJudgedWithProgressAndAllReports) {
  const TemporaryFolder folder;
  const fs::path pack = test::pack_folder("edge_splash-corrected"), port = folder / "port";
  fs::copy(pack, port, fs::copy_options::recursive);
  fs::remove(port / "manifest.json");
  int runs = 0;
  const Judgement good = Judgement::of_folder(pack, port, executor, {.progress = [&](int done, int of) {
                                                EXPECT_EQ(done, ++runs);
                                                EXPECT_LE(done, of);
                                              }});
  EXPECT_GT(runs, 1);
  EXPECT_EQ(good.verdict().status, "PASS");
  EXPECT_THAT(good.junit(), HasSubstr("failures=\"0\""));
  fs::remove_all(port / "edge_splash.splash");
  const Judgement part = Judgement::of_folder(pack, port, executor, {.partial = true});
  EXPECT_EQ(part.verdict().passes[0].status, "NOT JUDGED");
  EXPECT_THAT(part.junit(), HasSubstr("NOT JUDGED"));
  EXPECT_EQ(Judgement::of_folder(pack, port, executor, {.profile = "webgpu", .passes = {"display"}}).verdict().passes.size(), 1u);
  EXPECT_THAT(error_of([&] { Judgement::of_folder(pack, port, executor, {.profile = "vulcan"}); }), HasSubstr("did you mean 'vulkan'?"));
  EXPECT_THAT(error_of([&] { Judgement::of_folder(pack, folder / "none", executor); }), testing::StartsWith("3 "));
}

TEST(Profiles, AreListed) { EXPECT_THAT(profile_names(), testing::IsSupersetOf({"ieee", "vulkan", "webgpu", "d3d"})); }

}  // namespace
}  // namespace rainref
