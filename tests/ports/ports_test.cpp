// The ports on a software device: they run, the judge passes them, and it catches bugs seeded in them.
#include <map>

#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;
using testing::HasSubstr;

class Port : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, Port, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

TEST_P(Port, RunsEveryJudgedPassTwiceAlike) {
  const TemporaryFolder folder;
  const std::string pack = pack_of(GetParam());
  const Outcome run = run_port(pack, folder.path(), "--repeat 2");
  ASSERT_EQ(run.code, 0) << run.text;
  int outputs = 0;
  const auto manifest = nlohmann::json::parse(contents(pack + "/manifest.json"));
  for (const auto& c : manifest["cases"]) {
    for (const auto& output : c["outputs"]) {
      if (output["judge"] == "input_only") continue;
      const fs::path file = folder / output["file"];
      ASSERT_TRUE(fs::exists(file)) << file;
      EXPECT_EQ(fs::file_size(file), output["bytes"]) << file;
      ++outputs;
    }
  }
  EXPECT_GE(outputs, 10);
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "port.json"))["api"], "Vulkan");
}

TEST_P(Port, PassesUnderTheProfileOfItsApi) {
  const TemporaryFolder folder;
  const std::string pack = pack_of(GetParam());
  ASSERT_EQ(run_port(pack, folder.path()).code, 0);
  const Outcome verdict = judge(pack, folder.path());
  // The published march of a grazing ray has no useful bound, so that pass may be left unjudged; never failed.
  EXPECT_THAT(verdict.text, testing::Not(HasSubstr("FAIL"))) << verdict.text;
  EXPECT_EQ(judge(pack, folder.path(), "--allow-untested").code, 0) << verdict.text;
  for (const char* pass : {"wave_step", "shade", "display"})
    EXPECT_EQ(judge(pack, folder.path(), std::string("--only ") + pass).code, 0) << pass;
}

TEST_P(Port, PassesWhereTheShaderBlendsTexelsItself) {
  const TemporaryFolder folder;
  const std::string pack = pack_of(GetParam());
  ASSERT_EQ(run_port(pack, folder.path(), "--only surface_hit --spec 3=1").code, 0);
  EXPECT_EQ(judge(pack, folder.path(), "--only surface_hit").text.find("FAIL"), std::string::npos);
}

TEST(Port, DisplayInHlslPasses) {
  const TemporaryFolder folder;
  const Outcome run = run_port(pack_of("corrected"), folder.path(), "", "hlsl");
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("no program for")) << "the other passes are not ported, and the runner says so";
  const Outcome verdict = judge(pack_of("corrected"), folder.path(), "--only display");
  EXPECT_EQ(verdict.code, 0) << verdict.text;
}

TEST(Port, WaveStepInCudaPasses) {
  if (!fs::exists(spirv + "/cuda_wave_step")) GTEST_SKIP() << "built without nvcc";
  const TemporaryFolder folder;
  const Outcome run = call(quiet + "'" + spirv + "/cuda_wave_step' '" + pack_of("corrected") + "' '" + folder.path().string() + "'");
  if (run.text.find("cudaGetDeviceProperties") != std::string::npos) GTEST_SKIP() << "no CUDA device: " << run.text;
  ASSERT_EQ(run.code, 0) << run.text;
  const Outcome verdict = judge(pack_of("corrected"), folder.path(), "--only wave_step --profile cuda");
  EXPECT_EQ(verdict.code, 0) << verdict.text;
}

// What envelopes of lookups between two levels are made for (docs/notes/devices.md). Another device may weigh otherwise.
TEST(Port, AnH100WeighsTwoLevelsTogether) {
  if (!fs::exists(RAINREF_TWO_LEVELS)) GTEST_SKIP() << "built without nvcc";
  const Outcome run = call("'" RAINREF_TWO_LEVELS "'");
  if (run.text.find("cudaGetDeviceProperties") != std::string::npos) GTEST_SKIP() << "no CUDA device: " << run.text;
  if (run.text.find("H100") == std::string::npos) GTEST_SKIP() << "another device: " << run.text;
  EXPECT_EQ(run.code, 0) << run.text;
}

// One or two bugs of each pass; scripts/full/mutants has them all.
TEST(Port, SeededBugsGetTheirVerdicts) {
  const Outcome all = judge_mutants("puddle.json", "101,139,162,203,322,353,461,464,507,541,545");
  EXPECT_EQ(all.code, 0) << all.text;
}

// What a label says of the outputs is held to: 101 changes bits by a code, 139 by three, 113 none.
TEST(Port, FalseLabelsOfMutantsAreFound) {
  const auto outcome = [](const std::map<int, std::string>& labels) {
    const TemporaryFolder folder;
    auto all = nlohmann::json::parse(contents(source + "/tests/ports/mutants/puddle.json"));
    std::string ids;
    for (const auto& [id, label] : labels) {
      ids += (ids.empty() ? "" : ",") + std::to_string(id);
      for (auto& m : all["mutants"])
        if (m["id"] == id) m["expected"] = label;
    }
    put(folder / "mutants.json", all.dump());
    return run_mutants(folder / "mutants.json", ids);
  };
  const Outcome both = outcome({{101, "equivalent"}, {139, "equivalent"}}), one = outcome({{139, "below-storage-ulp"}});
  EXPECT_EQ(both.code, 1) << both.text;
  EXPECT_THAT(both.text, HasSubstr("2 outputs are not what their label says"));
  EXPECT_EQ(one.code, 1) << one.text;
  EXPECT_THAT(one.text, HasSubstr("1 outputs are not what their label says"));
  EXPECT_EQ(outcome({{113, "equivalent"}, {101, "below-storage-ulp"}, {139, "inside-envelope"}}).code, 0);
}

TEST(Port, MutantsAreManyAndNamedOnce) { EXPECT_GE(check_mutants("puddle.json"), 40u); }

// The blocks in the shaders are what describe prints for this version.
TEST(Port, UniformBlocksAreTheDescribedOnes) {
  EXPECT_GE(check_blocks("puddle", {"layout(std140, binding = 0) uniform ", "struct Drop {"}), 8);
}

// ---- rainy_glass ---------------------------------------------------------------------------------------------------
TEST_P(Port, OfRainyGlassPasses) {
  const TemporaryFolder folder;
  const std::string pack = source + "/tests/packs/rainy_glass-" + GetParam();
  const Outcome run = run_port(pack, folder.path(), "--repeat 2", "rainy_glass");
  ASSERT_EQ(run.code, 0) << run.text;
  const Outcome verdict = judge(pack, folder.path());
  EXPECT_EQ(verdict.code, 0) << verdict.text;
  EXPECT_THAT(verdict.text, HasSubstr("(4 PASS)"));
}
TEST(Port, SeededBugsOfRainyGlassGetTheirVerdicts) {
  const Outcome all = judge_mutants("rainy_glass.json", "702,734,784");
  EXPECT_EQ(all.code, 0) << all.text;
  EXPECT_GE(check_mutants("rainy_glass.json"), 40u);
}
TEST(Port, UniformBlocksOfRainyGlassAreTheDescribedOnes) {
  EXPECT_EQ(check_blocks("rainy_glass", {"layout(std140, binding = 0) uniform ", "struct Droplet {", "struct Trail {"}), 6);
}

}  // namespace
}  // namespace rainref
