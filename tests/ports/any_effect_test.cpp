// Effects that are none of rainref's own, judged by shaders that their authors trust: the page in examples/any_effect, as a user does it.
// wgsl_test.cpp has their ports in a browser.
#include "ports/any_effect.h"

#include <fstream>

namespace rainref::ports {
namespace {

using testing::HasSubstr, testing::Not;

class AnyEffects : public testing::Test {
 protected:
  void SetUp() override {
    if (!AnyEffect::made()) GTEST_SKIP() << "needs NumPy for /usr/bin/python3";
  }
  static Outcome run(const std::string& effect, const fs::path& shaders, const fs::path& out, const std::string& more = "") {
    return call(quiet + RAINREF_PORT_RUNNER " --device cpu --pack '" + AnyEffect::made()->pack(effect) + "' --spirv '" + shaders.string() +
                "' --out '" + out.string() + "' " + more);
  }
};

TEST_F(AnyEffects, EveryPassHasCasesThatSaySomething) {
  EXPECT_THAT(AnyEffect::made()->said(), HasSubstr("8 cases of fog shade in "));
  EXPECT_THAT(AnyEffect::made()->said(), HasSubstr("12 cases of wave caustics floor in "));
  EXPECT_THAT(AnyEffect::made()->said(), Not(HasSubstr("warning"))) << "a port that does nothing passes";
}

// The reference is HLSL, the port GLSL of another form.
TEST_F(AnyEffects, APortInGlslPassesOnASoftwareDevice) {
  const TemporaryFolder out;
  for (const std::string effect : AnyEffect::effects) {
    const fs::path shaders = AnyEffect::shaders(effect) + "/glsl";
    ASSERT_EQ(run(effect, shaders, out / effect).code, 0);
    const Outcome judged = judge(AnyEffect::made()->pack(effect), out / effect, "--spirv '" + shaders.string() + "'");
    EXPECT_EQ(judged.code, 0) << judged.text;
    EXPECT_THAT(judged.text, Not(HasSubstr("note:"))) << "the device did not do what the port says";
  }
}

// The cause is a mistake in the reference, the line one of the port's.
TEST_F(AnyEffects, AMistakeIsNamedInTheLineOfThePort) {
  const TemporaryFolder folder;
  const fs::path shaders = folder / "shaders";
  fs::copy(AnyEffect::shaders("fogged_glass") + "/glsl", shaders);
  std::string text = contents(source + "/examples/any_effect/fogged_glass/glsl/fog.comp");
  const std::string right = "u.dt / u.regrow_time";
  ASSERT_NE(text.find(right), std::string::npos);
  std::ofstream(shaders / "fog.comp") << text.replace(text.find(right), right.size(), "u.dt * u.regrow_time");
  ASSERT_EQ(call("cd '" + shaders.string() + "' && '" RAINREF_GLSLANG "' -V -g --target-env vulkan1.1 --quiet fog.comp -o fog.spv").code,
            0);
  ASSERT_EQ(run("fogged_glass", shaders, folder / "out", "--only fog").code, 0);
  const Outcome judged = judge(AnyEffect::made()->pack("fogged_glass"), folder / "out", "--only fog --spirv '" + shaders.string() + "'");
  EXPECT_EQ(judged.code, 1);
  EXPECT_THAT(judged.text, HasSubstr("likely cause: multiplied for divided: -dt / regrow_time"));
  EXPECT_THAT(judged.text, HasSubstr("\nfog.comp:46: float grown = mix(full, before, exp(-(u.dt * u.regrow_time)));\n"));
  EXPECT_THAT(judged.text, HasSubstr("the device did what this shader says"));
}

}  // namespace
}  // namespace rainref::ports
