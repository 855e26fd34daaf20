// The ports on a software device: they run, the judge passes them, and it catches bugs seeded in them.
#include <map>

#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;
using testing::HasSubstr;

// ---- every effect --------------------------------------------------------------------------------------------------
class EveryPort : public testing::TestWithParam<PackPasses> {};
INSTANTIATE_TEST_SUITE_P(Packs, EveryPort, testing::ValuesIn(proven_packs()), test::name_of_pack_test);

TEST_P(EveryPort, RunsTwiceAlikeAndPassesUnderTheProfileOfItsApi) {
  const TemporaryFolder folder;
  const std::string pack = pack_folder(GetParam().name);
  const Outcome run = run_port(pack, folder.path(), "--repeat 2", GetParam().effect);
  ASSERT_EQ(run.code, 0) << run.text;
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "port.json"))["api"], "Vulkan");
  // The published march of a grazing ray has no useful bound, so that pass may be left unjudged; never failed.
  const bool may_be_untested = GetParam().effect_and_variant() == "puddle-as-published";
  const Outcome verdict = judge(
      pack, folder.path(), std::string(may_be_untested ? "--allow-untested " : "") + "--spirv '" + spirv + "/" + GetParam().effect + "'");
  EXPECT_EQ(verdict.code, 0) << verdict.text;
  // What the device stored is what rainref says that these shaders may give, of every pass that is judged by texels.
  EXPECT_THAT(verdict.text, testing::Not(HasSubstr("SPIR-V says"))) << verdict.text;
  EXPECT_THAT(verdict.text, testing::Not(HasSubstr(".spv'"))) << "a refusal: " << verdict.text;
  EXPECT_THAT(verdict.text, testing::Not(HasSubstr("WARN"))) << verdict.text;
  if (may_be_untested) {
    EXPECT_EQ(judge(pack, folder.path(), "--only wave_step,shade,display").code, 0);
  }
}

/// Some bugs of each pass; scripts/full/mutants has them all.
struct Seeded {
  const char *file, *ids;
};
void PrintTo(const Seeded& s, std::ostream* out) { *out << s.file; }
class SeededBugs : public testing::TestWithParam<Seeded> {
 protected:
  const std::string file = std::string(GetParam().file) + ".json";
};
INSTANTIATE_TEST_SUITE_P(Files, SeededBugs,
                         testing::Values(Seeded{"puddle", "101,139,162,203,322,353,461,464,507,541,545"},
                                         Seeded{"windshield_surface",
                                                "1503,1533,1562,1581,1412,1413,1450,1453,1702,1714,1721,1759,1763,1778"},
                                         Seeded{"windshield_motion", "1104,1126,1146,1176,1189,1210"},
                                         Seeded{"windshield_trails_and_panes", "1602,1609,1612,1622,1627,1639,1652,1669"},
                                         Seeded{"edge_splash", "601,610,625,664,691"}, Seeded{"screen_drops", "1802,1823,1843,1898"},
                                         Seeded{"rainy_glass", "702,734,770,773,784"}),
                         [](const auto& tested) { return tested.param.file; });

TEST_P(SeededBugs, GetTheirVerdicts) {
  const Outcome all = judge_mutants(file, GetParam().ids);
  EXPECT_EQ(all.code, 0) << all.text;
}
TEST_P(SeededBugs, AreManyAndNamedOnce) { EXPECT_GE(check_mutants(file), 35u); }

// The blocks and records in the shaders are what describe prints for this version.
TEST(EveryPort, UniformBlocksAreTheDescribedOnes) {
  for (const auto& [effect, least] :
       std::map<std::string, int>{{"puddle", 8}, {"windshield", 12}, {"edge_splash", 3}, {"screen_drops", 7}, {"rainy_glass", 6}})
    EXPECT_GE(check_blocks(effect), least) << effect;
}

// ---- the puddle ----------------------------------------------------------------------------------------------------
class Port : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, Port, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

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

}  // namespace
}  // namespace rainref
