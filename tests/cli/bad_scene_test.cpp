// Scenes that cannot run: which exit code, which message, and nothing left behind.
#include "cli/support.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

using BadScene = CommandLine;

TEST_F(BadScene, MissingOrNoFile) {
  std::filesystem::create_directory(folder / "sub");
  before = folder.names();
  for (const std::string verb : {"hash", "run"}) {
    expect_refusal({verb, "none.toml"}, 4, "none.toml: cannot be read: No such file or directory");
    expect_refusal({verb, "sub"}, 4, "sub: expected a scene file, found a directory");
    expect_refusal({verb, "sky.png/x.toml"}, 4, "sky.png/x.toml: cannot be read: Not a directory");
  }
  expect_refusal({"hash", ""}, 4, HasSubstr("cannot be read"));
  expect_refusal({"hash", "two\nlines"}, 4, StartsWith("two lines: cannot be read"));
}

TEST_F(BadScene, AWrongPathNamesTheNearestScene) {
  const auto missing = [](const std::string& file) { return file + ": cannot be read: No such file or directory"; };
  for (const std::string verb : {"hash", "run"})
    expect_refusal({verb, "corected.toml"}, 4, missing("corected.toml") + "; did you mean 'corrected.toml'?");
  expect_refusal({"pack", "corected.toml", "-o", "new"}, 4, missing("corected.toml") + "; did you mean 'corrected.toml'?");
  // Those that come with the program, by their last folder.
  expect_refusal({"hash", "pudle/default.toml"}, 4, missing("pudle/default.toml") + "; did you mean 'puddle/default.toml'?");
  expect_refusal({"hash", "scenes/puddle/defualt.toml"}, 4,
                 missing("scenes/puddle/defualt.toml") + "; did you mean 'puddle/default.toml'?");
  std::filesystem::create_directories(folder / "scenes/deep");
  put(folder / "scenes/deep/mine.toml", "");
  before = folder.names();
  expect_refusal({"hash", "scenes/deep/mien.toml"}, 4, missing("scenes/deep/mien.toml") + "; did you mean 'scenes/deep/mine.toml'?");
  expect_refusal({"hash", "scenes/dep/mine.toml"}, 4, missing("scenes/dep/mine.toml") + "; did you mean 'scenes/deep/mine.toml'?");
}

TEST_F(BadScene, AKeyOfAnotherEffectNamesIt) {
  expect_scene_refused(scene("corrected", "[wipers]\ncount = 1\n"),
                       "x.toml:9:1: wipers.count: unknown key of 'puddle'; it is one of 'windshield'");
  expect_scene_refused(scene("corrected", "[vehicle]\n"), "x.toml:8:2: vehicle: unknown table of 'puddle'; it is one of 'windshield'");
  expect_refusal({"hash", "corrected.toml", "--set", "wipers.count=1"}, 2,
                 "--set wipers.count: unknown key of 'puddle'; it is one of 'windshield'");
  expect_refusal({"hash", "corrected.toml", "--set", "scene.margin=2"}, 2,
                 "--set scene.margin: unknown key of 'puddle'; it is one of 'windshield' and 'screen_drops'");
}

TEST_F(BadScene, NoToml) {
  expect_scene_refused("effect = 'puddle'\nvariant = = 1\n", StartsWith("x.toml:2:11: "));
  expect_scene_refused("", "x.toml: effect: missing; expected one of " + effect_list());
  // A picture may hold a scene; this one was made elsewhere.
  expect_refusal({"hash", "sky.png"}, 2, StartsWith("'sky.png': expected a scene, or a picture with the scene in it"));
}

// tests/scene has all that the parser says; this is how it is told.
TEST_F(BadScene, WhatTheParserSaysHasItsPlaceOrItsOption) {
  expect_scene_refused(scene("corrected", "[puddle]\ndampng = 0.9\n"),
                       "x.toml:9:1: puddle.dampng: unknown key; did you mean 'puddle.damping'?");
  const std::string damping = "puddle.damping: expected a number from 0.5 to 1 [1], found nan";
  expect_scene_refused(scene("as-published", "[puddle]\ndamping = nan\n"), "x.toml:9:11: " + damping);
  expect_refusal({"hash", "published.toml", "--set", "puddle.damping=nan"}, 2, "--set " + damping);
  expect_refusal({"hash", "corrected.toml", "--set", "effect=pudle"}, 2,
                 AllOf(StartsWith("--set effect: expected "), EndsWith("did you mean 'puddle'?")));
}

TEST_F(BadScene, AHugeSizeNamesTheMemoryItNeedsAndTakesNone) {
  Circumstances c;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  c.memory_bytes = rlim_t{16} << 30;  // in case this machine really has enough
#endif
  const Outcome o = rainref({"hash", "published.toml", "--size", "65536x65536"}, c);
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_LT(o.peak_kib, 512 * 1024);
  EXPECT_THAT(o.err,
              MatchesRegex("rainref: run\\.size 65536x65536 with a wave of 65536x65536 needs [0-9.]+ GiB of memory; .* [0-9.]+ [GM]iB\n"));
}

TEST_F(BadScene, TheProcesssOwnLimitIsNamed) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer reserves terabytes";
#endif
  Circumstances c;
  c.memory_bytes = rlim_t{600} << 20;
  const Outcome o = rainref({"hash", "corrected.toml", "--threads", "1", "--set", "puddle.grid=[8192, 8192]"}, c);
  EXPECT_EQ(o.code, 2);
  EXPECT_EQ(o.out, "");
  EXPECT_LT(o.peak_kib, 256 * 1024);
  EXPECT_THAT(o.err, MatchesRegex("rainref: run\\.size 24x16 with a wave of 8192x8192 needs [78][0-9]+\\.[0-9] MiB of memory; the limit "
                                  "RLIMIT_AS \\(ulimit -v\\) allows [0-9.]+ MiB\n"));
}

TEST_F(BadScene, AnUnstableWaveNamesTheLimit) {
  const auto message = AllOf(HasSubstr("puddle.wave_speed"), HasSubstr("puddle.step_rate"), HasSubstr("puddle.cell_size"),
                             HasSubstr("sqrt(1/2) = 0.707107"));
  expect_refusal({"hash", "corrected.toml", "--set", "puddle.wave_speed=50"}, 2, message);
  expect_refusal({"run", "corrected.toml", "--set", "puddle.wave_speed=50"}, 2, message);
  // The step rate that the message names is enough.
  expect_refusal({"hash", "corrected.toml", "--set", "puddle.wave_speed=5"}, 2, EndsWith("raise puddle.step_rate to 354 or more"));
  EXPECT_EQ(hash({"corrected.toml", "--set", "puddle.wave_speed=5", "--set", "puddle.step_rate=354"}).size(), 13u);
}

TEST_F(BadScene, ACameraThatLooksNowhere) {
  expect_refusal({"hash", "corrected.toml", "--set", "camera.position=[1,2,3]", "--set", "camera.target=[1,2,3]"}, 2,
                 AllOf(HasSubstr("camera"), HasSubstr("position and target coincide")));
  expect_refusal({"hash", "corrected.toml", "--set", "camera.up=[0,0,0]"}, 2, AllOf(HasSubstr("camera"), HasSubstr("up is zero")));
  expect_refusal({"hash", "corrected.toml", "--set", "camera.position=[0,9,0]", "--set", "camera.target=[0,0,0]"}, 2,
                 AllOf(HasSubstr("camera"), HasSubstr("parallel to the view")));
}

}  // namespace
}  // namespace rainref::cli
