// `rainref run` that begins in the middle, is killed, and goes on: the pictures are those of one run.
#include <cstring>
#include <map>
#include <random>

#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "cli/picture_files.h"
#include "cli/running.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Resumed : public CommandLine {
 protected:
  Resumed() {
    put(folder / "windshield.toml", R"(effect = "windshield"
variant = "corrected"
[run]
size = [40, 24]
fps = 30
[vehicle]
key_frames = "0 12 0.1; 1 9 0.4"
[windshield]
height_size = [64, 36]
capacity = 2000
[rain]
rate = 100
[scene]
size = [32, 18]
moves = false
)");
    put(folder / "trails.toml", R"(effect = "windshield"
variant = "as-published"
[run]
size = [40, 24]
[windshield]
height_size = [64, 36]
spawn_rate = 3000
height_tau = 0.5
blend = "max"
[scene]
size = [32, 18]
moves = false
)");
    before = folder.names();
  }

  /// Names and bytes of the pictures, and of the summary what does not tell of times.
  std::map<std::string, std::string> results(const std::string& in) const {
    std::map<std::string, std::string> all;
    for (const std::string& name : names(in)) all[name] = contents(folder / (in + "/" + name));
    const auto json = nlohmann::json::parse(all.at("summary.json"), nullptr, false);
    nlohmann::json kept;
    for (const char* key : {"config", "inputs", "frames", "last_frame", "golden_generation"}) kept[key] = json.value(key, nlohmann::json());
    for (const auto& pass : json["passes"]) kept["calls"].push_back({pass["name"], pass["calls"]});
    if (json.contains("truth")) kept["truth"] = json["truth"];
    all["summary.json"] = kept.dump();
    return all;
  }
  Outcome run(const std::vector<std::string>& arguments) const {
    const Outcome o = rainref(joined({"run"}, arguments));
    EXPECT_EQ(o.code, 0) << o.err;
    return o;
  }
  /// Kills a run once its checkpoint is there.
  void kill_after_checkpoint(const std::vector<std::string>& arguments, const std::string& in) const {
    const auto running = start_rainref(folder.path(), joined({"run", "-o", in, "--frames", "1000000"}, arguments));
    await([&] { return fs::exists(folder / (in + "/checkpoint.state")); });
    EXPECT_EQ(running->end(SIGKILL), -SIGKILL);
    EXPECT_FALSE(fs::exists(folder / (in + "/summary.json")));
  }
};

TEST_F(Resumed, AnyKillLeavesWhatGoesOn) {
  const char* asked = std::getenv("RAINREF_KILLS");
  const int kills = asked ? std::stoi(asked) : 2;  // one of each kind
  std::mt19937 random(5);
  int killed = 0, gone_on = 0;
  for (int round = 0; killed < kills; ++round) {
    ASSERT_LT(round, 4 * kills) << "the runs are over before they are killed";
    const std::vector<std::string> film{
        "run", round % 2 == 0 ? "windshield.toml" : "trails.toml", "--frames", "300", "--every", "9", "--first", "40", "--image", "both"};
    const auto in = [&](const std::string& to, const std::vector<std::string>& more) { return joined(joined(film, {"-o", to}), more); };
    const std::string whole = fmt::format("whole{}", round), parts = fmt::format("parts{}", round);
    ASSERT_EQ(rainref(in(whole, {})).code, 0);
    for (;;) {
      const fs::path checkpoint = folder / (parts + "/checkpoint.state");
      const auto written = [&] {
        std::error_code none;
        return fs::last_write_time(checkpoint, none);
      };
      const auto older = written();
      const auto running = start_rainref(folder.path(), in(parts, {"--checkpoint-every", "7", "--resume"}));
      if (killed < kills) {
        // Every other one has come further before it is killed, on however slow a machine.
        if (killed % 2 == 1) await([&] { return written() != older || !is_running(running->id()); });
        std::this_thread::sleep_for(std::chrono::milliseconds(random() % (killed % 2 == 1 ? 200 : 900)));
        const int code = running->end(SIGKILL);
        if (code == -SIGKILL) {
          ++killed;
          gone_on += fs::exists(checkpoint);
          continue;
        }
        ASSERT_EQ(code, 0);
      } else {
        ASSERT_EQ(running->wait(), 0);
      }
      break;
    }
    EXPECT_EQ(results(parts), results(whole));
    EXPECT_THAT(names(parts),
                testing::AllOf(Contains("windshield.0045.png"), Contains("windshield.0297.exr"), Not(Contains("windshield.0036.png"))));
    fs::remove_all(folder / whole);
    fs::remove_all(folder / parts);
  }
  EXPECT_GT(gone_on, 0);
}

// Every effect as the small scenes of the command line's tests have it.
TEST_F(Resumed, FromTheFirstFrameOfInterestThePicturesAreThose) {
  for (const std::string scene : {"corrected.toml", "published.toml", "windshield.toml", "trails.toml"}) {
    run({scene, "--frames", "12", "--every", "1", "-o", "all"});
    const Outcome o = run({scene, "--frames", "12", "--every", "1", "--first", "8", "-o", "last"});
    EXPECT_THAT(o.out, HasSubstr(", 4 pictures and"));
    auto all = results("all"), last = results("last");
    EXPECT_EQ(last.size(), 5u);
    last.erase("summary.json");
    for (const auto& [name, bytes] : last) EXPECT_EQ(bytes, all.at(name)) << name;
    fs::remove_all(folder / "all");
    fs::remove_all(folder / "last");
  }
  expect_refusal({"run", "corrected.toml", "--frames", "12", "--first", "12", "-o", "o"}, 2,
                 "--first 12: expected a frame before run.frames 12");
  expect_refusal({"run", "corrected.toml", "--first", "-1", "-o", "o"}, 2, HasSubstr("--first"));
}

TEST_F(Resumed, AWholeRunLeavesNoCheckpoint) {
  run({"published.toml", "--frames", "5", "-o", "o", "--checkpoint-every", "1", "--image", "none"});
  EXPECT_THAT(names("o"), testing::ElementsAre("summary.json"));
  // Nothing to go on from: from the beginning.
  const Outcome o = run({"published.toml", "--frames", "5", "-o", "o", "--resume", "--image", "none"});
  EXPECT_THAT(o.out, Not(HasSubstr("before")));
}

// Hours of work hung on one word. A run that begins anew says so, and what was left does not stay beside its results.
TEST_F(Resumed, ARunThatBeginsAnewForgetsTheCheckpoint) {
  kill_after_checkpoint({"published.toml", "--checkpoint-every", "3", "--every", "1"}, "o");
  const std::string state = contents(folder / "o/checkpoint.state");
  before = folder.names();
  expect_refusal(
      {"run", "published.toml", "--frames", "4", "-o", "o", "--image", "none"}, 2,
      "o: expected no other run's results, found the checkpoint.state of one that was killed: --resume goes on from it, --overwrite "
      "removes what that run left, -o names another folder");
  EXPECT_EQ(contents(folder / "o/checkpoint.state"), state);
  expect_refusal({"run", "published.toml", "--frames", "4", "-o", "o", "--resume", "--overwrite"}, 2,
                 "--overwrite: expected no --resume beside it: one begins anew, the other goes on");
  run({"published.toml", "--frames", "4", "-o", "o", "--image", "none", "--overwrite"});
  EXPECT_THAT(names("o"), testing::ElementsAre("summary.json"));
}

TEST_F(Resumed, OnlyTheSameRunGoesOn) {
  kill_after_checkpoint({"published.toml", "--checkpoint-every", "3", "--image", "none"}, "o");
  before = folder.names();
  const std::string state = contents(folder / "o/checkpoint.state");
  const auto refused = [&](const std::vector<std::string>& more, const testing::Matcher<const std::string&>& message,
                           const char* frames = "1000000") {
    expect_refusal(joined({"run", "published.toml", "-o", "o", "--resume", "--image", "none", "--frames", frames}, more), 2, message);
    EXPECT_EQ(contents(folder / "o/checkpoint.state"), state);
  };
  refused({"--set", "puddle.damping=0.5"},
          HasSubstr("o/checkpoint.state: of another scene: expected 'puddle.damping = 0.5', found 'puddle.damping = "));
  refused({"--every", "2"}, HasSubstr("o/checkpoint.state: of a run with --every 0: expected the same, found 2"));
  refused({"--capture", "all"}, HasSubstr("--capture: expected neither --checkpoint-every nor --resume"));
  refused({}, HasSubstr("run.frames 1: expected more than the "), "1");
  put(folder / "o/checkpoint.state", state.substr(0, state.size() / 2));
  expect_refusal({"run", "published.toml", "-o", "o", "--resume", "--image", "none"}, 2, HasSubstr("o/checkpoint.state: cut short"));
  put(folder / "o/checkpoint.state", "x");
  expect_refusal({"run", "published.toml", "-o", "o", "--resume", "--image", "none"}, 2,
                 HasSubstr("expected a state that rainref saved, found other bytes"));
  fs::remove(folder / "o/checkpoint.state");
  fs::create_directory(folder / "o/checkpoint.state");
  expect_refusal({"run", "published.toml", "-o", "o", "--resume", "--image", "none"}, 4, HasSubstr("checkpoint.state"));
}

// With a right checksum: what anybody could have written. The program's stack ends before the note does.
TEST_F(Resumed, ANoteOfAnotherShapeIsRefused) {
  kill_after_checkpoint({"published.toml", "--checkpoint-every", "3", "--image", "none"}, "o");
  const fs::path file = folder / "o/checkpoint.state";
  const std::string whole = contents(file);
  const std::size_t at = whole.find("{\"asked\":");
  const auto count_at = [&](const std::string& bytes, std::size_t place) {
    std::uint64_t count = 0;
    std::memcpy(&count, &bytes[place], sizeof count);
    return count;
  };
  const std::string note = whole.substr(at, count_at(whole, at - 8));
  const auto refused = [&](const std::string& other, const testing::Matcher<const std::string&>& message) {
    std::string forged = whole.substr(0, at) + other + whole.substr(at + note.size());
    const std::uint64_t note_bytes = other.size(), bytes = forged.size();
    std::memcpy(&forged[at - 8], &note_bytes, 8);
    std::memcpy(&forged[24], &bytes, 8);
    Hasher hasher(0);
    hasher.add(std::string_view(forged).substr(0, forged.size() - 16));
    const Hash128 hash = hasher.finish();
    std::memcpy(&forged[forged.size() - 16], &hash.low, 8);
    std::memcpy(&forged[forged.size() - 8], &hash.high, 8);
    put(file, forged);
    expect(rainref({"run", "published.toml", "-o", "o", "--resume", "--image", "none", "--frames", "1000000"}), 2, testing::_, message);
  };
  const auto with_truth = [&](const std::string& truth) {
    std::string other = note;
    return other.replace(other.find("\"truth\":[]"), 10, "\"truth\":" + truth);
  };
  refused(with_truth(std::string(300000, '[') + std::string(300000, ']')), HasSubstr("checkpoint.state: note: nested deeper than 16"));
  refused(with_truth("3"), HasSubstr("expected the state of an interrupted run"));
  refused("[]", HasSubstr("expected the state of an interrupted run"));
  refused("x", HasSubstr("checkpoint.state: note: not JSON: line 1, column 1"));
}

TEST_F(Resumed, ACheckpointThatCannotBeWrittenEndsTheRun) {
  const auto run_with = [&](const Circumstances& c) {
    return rainref({"run", "published.toml", "--frames", "9", "-o", "o", "--checkpoint-every", "2", "--image", "none"}, c);
  };
  Circumstances full;
  full.file_bytes = 100;
  expect(run_with(full), 4, testing::_, HasSubstr("checkpoint.state': File too large"));
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace rainref::cli
