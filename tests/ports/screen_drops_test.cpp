// The GLSL port of screen_drops on a software device: the judge passes it, and catches bugs seeded in it. The drops' own passes
// are the windshield's shaders.
#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;

class ScreenDropsPort : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, ScreenDropsPort, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

TEST_P(ScreenDropsPort, PassesUnderTheProfileOfItsApi) {
  const TemporaryFolder folder;
  const std::string pack = pack_of(GetParam(), "screen_drops");
  const Outcome run = run_port(pack, folder.path(), "--repeat 2", "screen_drops");
  ASSERT_EQ(run.code, 0) << run.text;
  const Outcome verdict = judge(pack, folder.path());
  EXPECT_EQ(verdict.code, 0) << verdict.text;
}

// Some bugs of each pass; scripts/full/mutants has them all.
TEST(ScreenDropsPort, SeededBugsGetTheirVerdicts) {
  const Outcome all = judge_mutants("screen_drops.json", "1802,1823,1843,1898");
  EXPECT_EQ(all.code, 0) << all.text;
}

TEST(ScreenDropsPort, MutantsAreManyAndNamedOnce) { EXPECT_GE(check_mutants("screen_drops.json"), 15u); }

// The blocks in the shaders are what describe prints for this version.
TEST(ScreenDropsPort, UniformBlocksAreTheDescribedOnes) {
  EXPECT_GE(check_blocks("screen_drops", {"layout(std140, binding = 0) uniform ", "struct Tap {"}), 7);
}

}  // namespace
}  // namespace rainref
