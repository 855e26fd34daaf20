// Bugs seeded in the GLSL port of edge_splash, on a software device.
#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;

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
