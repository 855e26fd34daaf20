// The windshield's ports on a software device: they run, the judge passes them, and it catches bugs seeded in them. Passes
// without a program yet are left out.
#include "ports/support.h"

namespace rainref {
namespace {

using namespace ports;
using testing::HasSubstr;

std::string windshield(const std::string& variant) { return pack_of(variant, "windshield"); }

/// Passes that a variant runs and a program of the folder computes.
std::vector<std::string> ported(const std::string& variant) {
  const auto bindings = nlohmann::json::parse(contents(fs::path(spirv) / "windshield" / "bindings.json"));
  const auto manifest = nlohmann::json::parse(contents(windshield(variant) + "/manifest.json"));
  std::vector<std::string> out;
  for (const auto& pass : manifest["passes"])
    if (bindings["programs"].contains(pass["formula"].get<std::string>())) out.push_back(pass["name"]);
  return out;
}

class WindshieldPort : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, WindshieldPort, testing::Values("as-published", "corrected"),
                         [](const auto& variant) { return variant.param[0] == 'a' ? "AsPublished" : "Corrected"; });

TEST_P(WindshieldPort, RunsTwiceAlikeAndPassesUnderTheProfileOfItsApi) {
  const TemporaryFolder folder;
  const std::string pack = windshield(GetParam());
  const Outcome run = run_port(pack, folder.path(), "--repeat 2", "windshield");
  ASSERT_EQ(run.code, 0) << run.text;
  const std::vector<std::string> passes = ported(GetParam());
  for (const char* listed : {"windshield_frame", "spawn", "integrate", "wipe_drops"}) EXPECT_THAT(passes, testing::Contains(listed));
  for (const char* drawn : {"splat", "wipe_texture", "normals", "blur_pyramid", "composite", "display"})
    EXPECT_THAT(passes, testing::Contains(drawn));
  for (const std::string& pass : passes) {
    const Outcome verdict = judge(pack, folder.path(), "--only " + pass);
    EXPECT_EQ(verdict.code, 0) << pass << '\n' << verdict.text;
  }
}

// Some bugs of each pass; scripts/full/mutants has them all.
TEST(WindshieldPort, SeededBugsGetTheirVerdicts) {
  const Outcome surface = judge_mutants("windshield_surface.json", "1503,1533,1562,1581,1412,1450");
  EXPECT_EQ(surface.code, 0) << surface.text;
  const Outcome motion = judge_mutants("windshield_motion.json", "1104,1126,1146,1176,1189,1210");
  EXPECT_EQ(motion.code, 0) << motion.text;
}

TEST(WindshieldPort, MutantsAreManyAndNamedOnce) {
  EXPECT_GE(check_mutants("windshield_surface.json") + check_mutants("windshield_motion.json"), 50u);
}

// The blocks in the shaders are what describe prints for this version.
TEST(WindshieldPort, UniformBlocksAreTheDescribedOnes) {
  EXPECT_GE(check_blocks("windshield", {"layout(std140, binding = 0) uniform ", "struct Drop {", "struct Wiper {", "struct Glint {",
                                        "struct GlassFrame {"}),
            9);
}

}  // namespace
}  // namespace rainref
