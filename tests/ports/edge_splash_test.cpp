// The GLSL port of edge_splash on a software device: the judge passes it, and catches bugs seeded in it.
#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;

class EdgeSplashPort : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, EdgeSplashPort, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

TEST_P(EdgeSplashPort, PassesUnderTheProfileOfItsApi) {
  const TemporaryFolder folder;
  const std::string pack = pack_of(GetParam(), "edge_splash");
  const Outcome run = run_port(pack, folder.path(), "--repeat 2", "edge_splash");
  ASSERT_EQ(run.code, 0) << run.text;
  const Outcome verdict = judge(pack, folder.path());
  EXPECT_EQ(verdict.code, 0) << verdict.text;
}

// Some bugs of each pass; scripts/full/mutants has them all.
TEST(EdgeSplashPort, SeededBugsGetTheirVerdicts) {
  const Outcome all = judge_mutants("edge_splash.json", "601,610,625,664,691");
  EXPECT_EQ(all.code, 0) << all.text;
}

TEST(EdgeSplashPort, MutantsAreManyAndNamedOnce) { EXPECT_GE(check_mutants("edge_splash.json"), 15u); }

// The blocks in the shaders are what describe prints for this version.
TEST(EdgeSplashPort, UniformBlocksAreTheDescribedOnes) {
  EXPECT_EQ(check_blocks("edge_splash", {"layout(std140, binding = 0) uniform "}), 3);
}

}  // namespace
}  // namespace rainref
