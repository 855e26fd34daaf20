// Bugs seeded in the GLSL port of screen_drops, on a software device. The drops' own passes are the windshield's shaders.
#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;

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
