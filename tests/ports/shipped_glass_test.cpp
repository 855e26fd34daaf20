// The shader that the author of rainy_glass's article ships: a port of it that was made from the facts in the document, with their numbers
// in it, is what scenes/rainy_glass/shipped.toml is judged by.
#include "ports/support.h"

namespace rainref::ports {
namespace {

using testing::HasSubstr;
using testing::Not;

class ShippedGlass : public testing::Test {
 protected:
  ShippedGlass() {
    fs::copy(source + "/tests/ports/shipped_glass", folder / "port");
    const Outcome compiled = call("cd '" + (folder / "port").string() +
                                  "' && '" RAINREF_GLSLANG "' -V --target-env vulkan1.1 --quiet rain_on_glass.comp -o rain_on_glass.spv");
    EXPECT_EQ(compiled.code, 0) << compiled.text;
  }
  /// What the judge says of that port on a small pack of a scene of rainy_glass.
  Outcome judged(const std::string& scene, const std::string& more = "") {
    const fs::path pack = folder / "pack", out = folder / "out";
    fs::remove_all(pack);
    fs::remove_all(out);
    const Outcome packed =
        call(RAINREF_PROGRAM " pack '" + source + "/scenes/rainy_glass/" + scene + ".toml' --size 96x54 --at 0,37,83 " +
             "--set scene.panorama='" + (test::pack_sources() / "sky.png").string() + "' " + more + " -o '" + pack.string() + "'");
    EXPECT_EQ(packed.code, 0) << packed.text;
    const Outcome ran = call(quiet + RAINREF_PORT_RUNNER " --device cpu --only rain_on_glass --pack '" + pack.string() + "' --spirv '" +
                             (folder / "port").string() + "' --out '" + out.string() + "'");
    EXPECT_EQ(ran.code, 0) << ran.text;
    return judge(pack.string(), out, "--only rain_on_glass --no-causes");
  }
  const TemporaryFolder folder;
};

TEST_F(ShippedGlass, APortMadeFromTheFactsPasses) {
  for (const char* shape : {"--set glass.shape=pane", "--set glass.shape=sphere --set glass.radius=0.3"}) {
    const Outcome verdict = judged("shipped", shape);
    EXPECT_EQ(verdict.code, 0) << verdict.text;
    EXPECT_THAT(verdict.text, HasSubstr("PASS"));
    EXPECT_THAT(verdict.text, Not(HasSubstr("WARN"))) << verdict.text;
  }
}

// Each reading counts: with one of them as in the article the same port fails.
TEST_F(ShippedGlass, ThatPortFailsWhereOneReadingIsTheArticles) {
  for (const char* article :
       {"maps.remap=after", "rain.time_offset=stored", "rain.flow_across='[0, 1]'", "rain.flow_along='[0, 1]'", "rain.rivulet_speed=0",
        "rain.flow_weight=triangle", "rain.fade_from=0", "glass.tint='[1, 1, 1]'", "glass.rivulet_tile=0.3"}) {
    const Outcome verdict = judged("shipped", std::string("--set glass.shape=sphere --set glass.radius=0.3 --set ") + article);
    EXPECT_EQ(verdict.code, 1) << article << '\n' << verdict.text;
  }
  EXPECT_EQ(judged("as_published").code, 1);
}

TEST_F(ShippedGlass, TheExamplePortPassesOnItsSmallPack) {
  const Outcome ran = run_port(pack_folder("rainy_glass-shipped").string(), folder / "out", "", "rainy_glass");
  ASSERT_EQ(ran.code, 0) << ran.text;
  const Outcome verdict = judge(pack_folder("rainy_glass-shipped").string(), folder / "out", "--spirv '" + spirv + "/rainy_glass'");
  EXPECT_EQ(verdict.code, 0) << verdict.text;
  EXPECT_THAT(verdict.text, Not(HasSubstr("WARN"))) << verdict.text;
  EXPECT_THAT(verdict.text, Not(HasSubstr("SPIR-V says"))) << verdict.text;
}

}  // namespace
}  // namespace rainref::ports
