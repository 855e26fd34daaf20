// What a user sees who asks for help or slips on the keyboard.
#include "base/shell.h"
#include "cli/support.h"
#include "math/simd_target.h"
#include "rainref/version.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

using Usage = CommandLine;

TEST_F(Usage, HelpShowsAnExample) {
  for (const std::string verb : {"list", "describe", "run", "view", "hash", "pack", "diff", "selftest", "demo"}) {
    expect(rainref({verb, "--help"}), 0, HasSubstr("\nExample: rainref " + verb), "");
  }
  const Outcome all = rainref({"--help"});
  EXPECT_EQ(all.code, 0);
  EXPECT_THAT(all.out, HasSubstr("\nExample: rainref run "));
  for (const std::string verb : {"list", "describe", "run", "view", "hash", "pack", "diff", "selftest", "demo"})
    EXPECT_THAT(all.out, HasSubstr("\n  " + verb + " "));
  EXPECT_EQ(rainref({"-h"}).out, all.out);
}

TEST_F(Usage, HelpIsAVerbToo) {
  EXPECT_EQ(rainref({"help"}).out, rainref({"--help"}).out);
  for (const std::string verb : {"run", "validate"}) {
    expect(rainref({"help", verb}), 0, rainref({verb, "--help"}).out, "");
  }
  expect_refusal({"help", "rnu"}, 2, EndsWith("found 'rnu'; did you mean 'run'?"));
  expect_refusal({"help", "run", "hash"}, 2, "help: expected one verb, found 'hash' too");
}

TEST_F(Usage, HelpSaysWhatAValueIs) {
  const auto help = [&](const char* verb) { return rainref({verb, "--help"}).out; };
  for (const char* verb : {"list", "describe", "run", "view", "hash", "pack", "diff", "validate", "mutate", "import", "selftest", "demo"})
    EXPECT_THAT(help(verb), Not(HasSubstr("TEXT"))) << verb;
  EXPECT_THAT(help("run"), AllOf(HasSubstr("SCENE FILE"), HasSubstr("--frames N"), HasSubstr("--size WxH"), HasSubstr("--threads N"),
                                 HasSubstr("--set KEY=VALUE"), HasSubstr("--output DIR")));
  EXPECT_THAT(help("validate"), AllOf(HasSubstr("--port DIR"), HasSubstr("--timeout SECONDS"), HasSubstr("--repeat N"),
                                      HasSubstr("--junit FILE"), HasSubstr("--exec COMMAND")));
}

TEST_F(Usage, HelpNamesTheProfilesThatJudge) {
  for (const char* verb : {"validate", "mutate"})
    EXPECT_THAT(rainref({verb, "--help"}).out, HasSubstr("cuda|d3d|gles|ieee|metal|opencl|opengl|vulkan|webgl|webgpu"));
}

TEST_F(Usage, VersionIsOneLine) {
  expect(rainref({"--version"}), 0, MatchesRegex("rainref [0-9]+\\.[0-9]+\\.[0-9]+, golden [0-9]+ [0-9a-f]{32}\n"));
}

/// The hash of the golden lines that begin so, as anybody can reckon it.
std::string golden_hash_of(const std::string& start) {
  return output_of(fmt::format("grep '^{}' '{}/tests/golden/hashes.txt' | sha256sum", start, test::source_folder())).first.substr(0, 32);
}
TEST_F(Usage, VersionNamesTheGoldenFile) { EXPECT_THAT(rainref({"--version"}).out, EndsWith(" " + golden_hash_of("") + "\n")); }
TEST_F(Usage, AnEffectHasAGoldenHashOfItsOwn) {
  for (const char* effect : {"puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"})
    EXPECT_EQ(golden_hash(effect), golden_hash_of(fmt::format("{}/", effect)));
  EXPECT_STREQ(golden_hash("breath"), "");
}

TEST_F(Usage, AVerbIsNeeded) {
  expect_refusal({}, 2, HasSubstr("required"));
  expect_refusal(
      {"lst"}, 2,
      "expected one of list, describe, run, view, hash, pack, diff, validate, mutate, import, sweep, selftest, demo, found 'lst'; did you "
      "mean 'list'?");
  expect_refusal({"Run", "corrected.toml"}, 2, EndsWith("found 'Run'; did you mean 'run'?"));
  expect_refusal({"zebra"}, 2, EndsWith("found 'zebra'"));
}

TEST_F(Usage, AnUnknownOptionNamesTheNearest) {
  expect_refusal({"list", "--jsn"}, 2, "--jsn: unknown option of 'list'; did you mean '--json'?");
  expect_refusal({"hash", "--frmes", "3", "corrected.toml"}, 2, "--frmes: unknown option of 'hash'; did you mean '--frames'?");
  expect_refusal({"hash", "corrected.toml", "--simd=avx2", "--thread=2"}, 2,
                 "--thread: unknown option of 'hash'; did you mean '--threads'?");
  expect_refusal({"run", "--outptu", "x"}, 2, "--outptu: unknown option of 'run'; did you mean '--output'?");
  expect_refusal({"run", "-x"}, 2, "-x: unknown option of 'run'");
  expect_refusal({"--vresion"}, 2, "--vresion: unknown option; did you mean '--version'?");
  expect_refusal({"hash", "corrected.toml", "--every", "2"}, 2, "--every: unknown option of 'hash'");
  expect_refusal({"hash", "corrected.toml", "--zebra"}, 2, "--zebra: unknown option of 'hash'");
}

TEST_F(Usage, AnOptionsValueIsNoOption) {
  expect_refusal({"hash", "corrected.toml", "--simd", "--zebra"}, 2, StartsWith("SIMD target '--zebra': "));
}

TEST_F(Usage, MissingAndSpareArguments) {
  expect_refusal({"hash"}, 2, StartsWith("SCENE is required"));
  expect_refusal({"describe"}, 2, "expected either EFFECT or --spirv, found neither");
  expect_refusal({"hash", "corrected.toml", "spare"}, 2, HasSubstr("spare"));
  expect_refusal({"hash", "corrected.toml", "--frames"}, 2, StartsWith("--frames: "));
  expect_refusal({"hash", "corrected.toml", "--set"}, 2, StartsWith("--set: "));
  expect_refusal({"hash", "corrected.toml", "--frames", "1", "--frames", "2"}, 2, StartsWith("--frames: "));
}

TEST_F(Usage, UnknownEffectOrLayout) {
  expect_refusal({"describe", "pudle"}, 2, "effect: expected one of " + effect_list() + ", found 'pudle'; did you mean 'puddle'?");
  expect_refusal({"describe", "puddle", "--layout", "glls"}, 2,
                 "layout: expected one of 'c', 'glsl', 'hlsl', 'wgsl', 'cuda', 'glsl330', 'gdshader', found 'glls'; did you mean 'glsl'?");
  expect_refusal({"describe", "puddle", "--layout", ""}, 2, StartsWith("layout: expected one of 'c', "));
}

TEST_F(Usage, UnknownPassOrVariantOfALayout) {
  expect_refusal({"describe", "puddle", "--layout", "glsl", "--pass", "shad"}, 2,
                 "--pass: expected one of raindrops, wave_step, surface_hit, ground_noise, shade, display, found 'shad'; did you mean "
                 "'shade'?");
  expect_refusal({"describe", "puddle", "--layout", "glsl", "--variant", "corected"}, 2,
                 "--variant: expected one of as-published, corrected, found 'corected'; did you mean 'corrected'?");
  expect_refusal({"describe", "windshield", "--layout", "glsl", "--pass", "merge", "--variant", "as-published"}, 2,
                 "--variant: expected one of corrected, in which merge runs, found 'as-published'");
  expect_refusal({"describe", "puddle", "--pass", "shade"}, 2, "--pass: only beside --layout");
  expect_refusal({"describe", "puddle", "--variant", "corrected"}, 2, "--variant: only beside --layout");
}

TEST_F(Usage, Size) {
  const std::string range = "--size: expected a whole number from 1 to 65536, found ";
  expect_refusal({"hash", "corrected.toml", "--size", "12"}, 2, "--size: expected WxH such as 1280x720, found '12'");
  expect_refusal({"hash", "corrected.toml", "--size", ""}, 2, "--size: expected WxH such as 1280x720, found ''");
  for (const auto& [size, found] : std::vector<std::pair<std::string, std::string>>{{"0x5", "'0'"},
                                                                                    {"5x", "''"},
                                                                                    {"x5", "''"},
                                                                                    {"5x5x5", "'5x5'"},
                                                                                    {"-3x5", "'-3'"},
                                                                                    {"70000x3", "'70000'"},
                                                                                    {"1.5x2", "'1.5'"},
                                                                                    {"ax5", "'a'"}}) {
    expect_refusal({"hash", "corrected.toml", "--size", size}, 2, range + found);
  }
}

TEST_F(Usage, ASizeMayHaveACapitalX) {
  EXPECT_EQ(hash({"corrected.toml", "--size", "20X12", "--frames", "1"}), hash({"corrected.toml", "--size", "20x12", "--frames", "1"}));
}

TEST_F(Usage, NumbersOfFramesThreadsAndPictures) {
  for (const std::string threads : {"0", "-1", "x", "", "1025", "2.0", "99999999999999999999"}) {
    expect_refusal({"hash", "corrected.toml", "--threads", threads}, 2,
                   "--threads: expected a whole number from 1 to 1024, found '" + threads + "'");
  }
  for (const std::string frames : {"0", "-5", "1.5", "", "1000001"}) {
    expect_refusal({"run", "corrected.toml", "--frames", frames}, 2,
                   "--frames: expected a whole number from 1 to 1000000, found '" + frames + "'");
    expect_refusal({"run", "corrected.toml", "--every", frames}, 2,
                   "--every: expected a whole number from 1 to 1000000, found '" + frames + "'");
  }
}

TEST_F(Usage, AnUnknownSimdTargetNamesThoseOfThisMachine) {
  expect_refusal({"hash", "corrected.toml", "--simd", "zebra"}, 2,
                 fmt::format("SIMD target 'zebra': this machine has {}", fmt::join(simd_targets(), ", ")));
  if (simd_targets().back() == "scalar")
    expect_refusal({"hash", "corrected.toml", "--simd", "scaler"}, 2, EndsWith("did you mean 'scalar'?"));
  const bool has_it = simd_targets().front() == "avx3";
  for (const char* name : {"avx512", "AVX512", "avx-512", "avx512f"}) {
    expect_refusal({"hash", "corrected.toml", "--simd", name}, 2,
                   EndsWith(has_it ? "; did you mean 'avx3'?" : "; AVX-512 is called avx3, which is not among them"));
  }
  expect_refusal({"hash", "corrected.toml", "--simd", ""}, 2, HasSubstr(fmt::format("{}", fmt::join(simd_targets(), ", "))));
}

TEST_F(Usage, AnUnknownKindOfPicture) {
  expect_refusal({"run", "corrected.toml", "--image", "pgn"}, 2,
                 "--image: expected exr, png, both or none, found 'pgn'; did you mean 'png'?");
  expect_refusal({"run", "corrected.toml", "-o", ""}, 2, "--output: expected a folder, found ''");
}

TEST_F(Usage, AStandardErrorThatTakesNothingChangesNothing) {
  Circumstances c;
  c.closed_error = true;
  EXPECT_EQ(rainref({"zebra"}, c).code, 2);
  EXPECT_EQ(rainref({"hash", "none.toml"}, c).code, 4);
}

}  // namespace
}  // namespace rainref::cli
