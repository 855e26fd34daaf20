// Bugs seeded in the windshield's ports, on a software device.
#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;

// Some bugs of each pass; scripts/full/mutants has them all.
TEST(WindshieldPort, SeededBugsGetTheirVerdicts) {
  const Outcome surface = judge_mutants("windshield_surface.json", "1503,1533,1562,1581,1412,1413,1450,1453,1702,1714,1721,1759,1763,1778");
  EXPECT_EQ(surface.code, 0) << surface.text;
  const Outcome motion = judge_mutants("windshield_motion.json", "1104,1126,1146,1176,1189,1210");
  EXPECT_EQ(motion.code, 0) << motion.text;
  const Outcome others = judge_mutants("windshield_trails_and_panes.json", "1602,1609,1612,1622,1627,1639,1652,1669");
  EXPECT_EQ(others.code, 0) << others.text;
}

TEST(WindshieldPort, MutantsAreManyAndNamedOnce) {
  EXPECT_GE(check_mutants("windshield_surface.json") + check_mutants("windshield_motion.json"), 50u);
  EXPECT_GE(check_mutants("windshield_trails_and_panes.json"), 50u);
}

// The blocks in the shaders are what describe prints for this version.
TEST(WindshieldPort, UniformBlocksAreTheDescribedOnes) {
  EXPECT_GE(check_blocks("windshield", {"layout(std140, binding = 0) uniform ", "struct Drop {", "struct Wiper {", "struct Glint {",
                                        "struct Neck {", "struct GlassFrame {", "struct Streak {"}),
            12);
}

}  // namespace
}  // namespace rainref
