// The GLSL port of edge_splash on a software device: the judge passes it, and catches bugs seeded in it.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"

namespace rainref {
namespace {

namespace fs = std::filesystem;

const std::string source = RAINREF_SOURCE_DIR, spirv = RAINREF_SPIRV "/edge_splash";
// A driver is not built with sanitizers.
const std::string quiet = "ASAN_OPTIONS=detect_leaks=0 TSAN_OPTIONS=report_bugs=0 ";

struct Outcome {
  int code;
  std::string text;  ///< standard output and error
};
Outcome call(const std::string& command) {
  const TemporaryFolder folder;
  const fs::path log = folder / "log";
  const int status = std::system((command + " >'" + log.string() + "' 2>&1").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(log)};
}

class EdgeSplashPort : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, EdgeSplashPort, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

TEST_P(EdgeSplashPort, PassesUnderTheProfileOfItsApi) {
  const TemporaryFolder folder;
  const std::string pack = source + "/tests/packs/edge_splash-" + GetParam();
  const Outcome run = call(quiet + RAINREF_PORT_RUNNER " --device cpu --repeat 2 --pack '" + pack + "' --spirv '" + spirv + "' --out '" +
                           folder.path().string() + "'");
  ASSERT_EQ(run.code, 0) << run.text;
  const Outcome verdict = call(RAINREF_PROGRAM " validate '" + pack + "' --port '" + folder.path().string() + "'");
  EXPECT_EQ(verdict.code, 0) << verdict.text;
}

// Some bugs of each pass; scripts/full/mutants has them all.
TEST(EdgeSplashPort, SeededBugsGetTheirVerdicts) {
  const TemporaryFolder folder;
  const Outcome all =
      call(quiet + RAINREF_PORT_MUTANTS " --device cpu --mutants '" + source + "/tests/ports/edge_splash/mutants.json' --packs '" + source +
           "/tests/packs' --spirv '" + spirv + "' --rainref '" RAINREF_PROGRAM "' --out '" + folder.path().string() +
           "' --ids 601,602,610,621,625,656,664,672,691");
  EXPECT_EQ(all.code, 0) << all.text;
}

TEST(EdgeSplashPort, MutantsAreNamedOnceAndInTheShaders) {
  const auto all = nlohmann::json::parse(contents(source + "/tests/ports/edge_splash/mutants.json"))["mutants"];
  EXPECT_GE(all.size(), 15u);
  std::string shaders;
  for (const auto& file : fs::directory_iterator(source + "/tests/ports/edge_splash")) {
    if (file.path().extension() == ".comp") shaders += contents(file.path());
  }
  std::vector<std::string> names;
  for (const auto& m : all) {
    names.push_back(m["id"].dump() + m["pass"].dump() + m["variant"].dump());
    EXPECT_TRUE(std::regex_search(shaders, std::regex("BUG [!=]= " + m["id"].dump() + "\\b"))) << "no shader has bug " << m["id"];
    const std::vector<std::string> verdicts{"FAIL", "equivalent", "below-storage-ulp", "inside-envelope", "UNTESTED"};
    EXPECT_THAT(verdicts, testing::Contains(m["expected"])) << m;
    EXPECT_EQ(m["expected"] != "FAIL", m.contains("reason")) << m;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

// The blocks in the shaders are what describe prints for this version.
TEST(EdgeSplashPort, UniformBlocksAreTheDescribedOnes) {
  const std::string described = call(RAINREF_PROGRAM " describe edge_splash --layout glsl").text;
  for (const char* shader : {"splash_as_published.comp", "splash_corrected.comp", "display.comp"}) {
    const std::string text = contents(source + "/tests/ports/edge_splash/" + shader);
    const std::size_t begin = text.find("layout(std140, binding = 0) uniform ");
    ASSERT_NE(begin, std::string::npos) << shader;
    EXPECT_THAT(described, testing::HasSubstr(text.substr(begin, text.find("\n}", begin) + 2 - begin))) << shader;
  }
}

}  // namespace
}  // namespace rainref
