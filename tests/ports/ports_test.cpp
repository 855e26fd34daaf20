// The ports on a software device: they run, the judge passes them, and it catches bugs seeded in them.
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
  if (!fs::exists(spirv + "/cuda_two_levels")) GTEST_SKIP() << "built without nvcc";
  const Outcome run = call("'" + spirv + "/cuda_two_levels'");
  if (run.text.find("cudaGetDeviceProperties") != std::string::npos) GTEST_SKIP() << "no CUDA device: " << run.text;
  if (run.text.find("H100") == std::string::npos) GTEST_SKIP() << "another device: " << run.text;
  EXPECT_EQ(run.code, 0) << run.text;
}

// One or two bugs of each pass; scripts/full/mutants has them all.
TEST(Port, SeededBugsGetTheirVerdicts) {
  const TemporaryFolder folder;
  const Outcome all = call(quiet + RAINREF_PORT_MUTANTS " --device cpu --mutants '" + source + "/tests/ports/mutants.json' --packs '" +
                           source + "/tests/packs' --spirv '" + spirv + "/glsl' --rainref '" RAINREF_PROGRAM "' --out '" +
                           folder.path().string() + "' --ids 101,106,138,139,203,252,322,334,353,412,456,461,504,507");
  EXPECT_EQ(all.code, 0) << all.text;
}

// What a label says of the outputs is held to: 101 changes bits by a code, 139 by three, 113 none.
TEST(Port, FalseLabelsOfMutantsAreFound) {
  const auto outcome = [](int id, const std::string& label) {
    const TemporaryFolder folder;
    auto all = nlohmann::json::parse(contents(source + "/tests/ports/mutants.json"));
    for (auto& m : all["mutants"])
      if (m["id"] == id) m["expected"] = label;
    put(folder / "mutants.json", all.dump());
    return call(quiet + RAINREF_PORT_MUTANTS " --device cpu --mutants '" + (folder / "mutants.json").string() + "' --packs '" + source +
                "/tests/packs' --spirv '" + spirv + "/glsl' --ids " + std::to_string(id));
  };
  for (const auto& [id, label] : {std::pair{101, "equivalent"}, {139, "equivalent"}, {139, "below-storage-ulp"}}) {
    const Outcome run = outcome(id, label);
    EXPECT_EQ(run.code, 1) << run.text;
    EXPECT_THAT(run.text, testing::HasSubstr("1 outputs are not what their label says"));
  }
  for (const auto& [id, label] : {std::pair{113, "equivalent"}, {101, "below-storage-ulp"}, {139, "inside-envelope"}})
    EXPECT_EQ(outcome(id, label).code, 0);
}

TEST(Port, MutantsAreManyAndNamedOnce) {
  EXPECT_GE(check_mutants(source + "/tests/ports/mutants.json", source + "/tests/ports/glsl"), 40u);
}

// The blocks in the shaders are what describe prints for this version.
TEST(Port, UniformBlocksAreTheDescribedOnes) {
  EXPECT_GE(check_blocks("puddle", source + "/tests/ports/glsl", {"layout(std140, binding = 0) uniform ", "struct Drop {"}), 8);
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
  const TemporaryFolder folder;
  const std::string mutants = source + "/tests/ports/rainy_glass/mutants.json";
  const Outcome all =
      call(quiet + RAINREF_PORT_MUTANTS " --device cpu --mutants '" + mutants + "' --packs '" + source + "/tests/packs' --spirv '" + spirv +
           "/rainy_glass' --rainref '" RAINREF_PROGRAM "' --out '" + folder.path().string() + "' --ids 702,713,734,762,784,796");
  EXPECT_EQ(all.code, 0) << all.text;
  std::string shaders;
  for (const auto& file : fs::directory_iterator(source + "/tests/ports/rainy_glass")) shaders += contents(file.path());
  const auto listed = nlohmann::json::parse(contents(mutants))["mutants"];
  EXPECT_GE(listed.size(), 40u);
  for (const auto& m : listed) {
    EXPECT_TRUE(std::regex_search(shaders, std::regex("BUG [!=]= " + m["id"].dump() + "\\b"))) << "no shader has bug " << m["id"];
    EXPECT_EQ(m["expected"] != "FAIL", m.contains("reason")) << m;
  }
}
TEST(Port, UniformBlocksOfRainyGlassAreTheDescribedOnes) {
  const std::string described = call(RAINREF_PROGRAM " describe rainy_glass --layout glsl").text;
  int blocks = 0;
  for (const auto& file : fs::directory_iterator(source + "/tests/ports/rainy_glass")) {
    const std::string text = contents(file.path());
    for (const char* opening : {"layout(std140, binding = 0) uniform ", "struct Droplet {", "struct Trail {"}) {
      const std::size_t begin = text.find(opening);
      if (begin == std::string::npos) continue;
      EXPECT_THAT(described, HasSubstr(text.substr(begin, text.find("\n}", begin) + 2 - begin))) << file.path();
      ++blocks;
    }
  }
  EXPECT_EQ(blocks, 6);
}

// ---- the runner refuses what it cannot run -------------------------------------------------------------------------
TEST(PortRunner, NamesTheFileAndWhatItExpected) {
  const TemporaryFolder folder;
  const fs::path pack = folder / "pack";
  fs::copy(pack_of("corrected"), pack, fs::copy_options::recursive);
  const fs::path wave = pack / "puddle.wave_step/0011.0/in.wave.npy";
  fs::copy_file(pack / "puddle.display/0011.0/out.picture.npy", wave, fs::copy_options::overwrite_existing);
  EXPECT_THAT(run_port(pack, folder / "out", "--only wave_step").text,
              HasSubstr("in.wave.npy: expected '<f2' (19, 29, 2), found '|u1' (21, 35, 4)"));
  fs::remove(wave);
  EXPECT_THAT(run_port(pack, folder / "out", "--only wave_step").text, HasSubstr("in.wave.npy: cannot be read"));
  put(pack / "puddle.display/0011.0/uniforms.bin", "short");
  EXPECT_THAT(run_port(pack, folder / "out", "--only display").text, HasSubstr("uniforms.bin: expected 16 bytes, found 5"));
  put(pack / "manifest.json", R"({"format": "rainref.pack", "version": 2})");
  EXPECT_THAT(run_port(pack, folder / "out").text, HasSubstr("this runner knows version 1, the pack has 2"));
}
TEST(PortRunner, RefusesUnknownOptionsDevicesAndPasses) {
  const TemporaryFolder folder;
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--sped 0=1").text, HasSubstr("--sped: unknown"));
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--spec 0").text, HasSubstr("--spec: expected ID=VALUE, found '0'"));
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--device 99").text, HasSubstr("--device 99: expected cpu or a number below"));
  EXPECT_THAT(run_port(pack_of("corrected"), folder.path(), "--only sheen").text, HasSubstr("no case of this pass has a program"));
  EXPECT_THAT(call(RAINREF_PORT_RUNNER " --list").text, HasSubstr("llvmpipe"));
}

}  // namespace
}  // namespace rainref
