// A configuration has typed values, knows where they came from, and is a scene that loads as itself.
#include "scene/config.h"

#include <nlohmann/json.hpp>

#include "scene/example_effect.h"
#include "scene/json.h"
#include "scene/toml.h"

namespace rainref::scene {
namespace {

const std::string scene = R"(effect = "puddle"
variant = "corrected"
seed = 9223372036854775807

[run]
size = [640, 480]

[puddle]
damping = 0.96
ground = "tiles \"x\".png"

[camera]
position = [0.1, 2, -3e-7]
)";

Config example(const std::vector<std::string>& overrides = {}) {
  return parse(scene, "scenes/puddle/x.toml", overrides, example_effects());
}

TEST(Config, HasTypedValues) {
  const Config c = example({"puddle.blend=max"});
  EXPECT_EQ(c.effect(), "puddle");
  EXPECT_EQ(c.variant(), "corrected");
  EXPECT_EQ(c.integer("seed"), 9223372036854775807);
  EXPECT_EQ(c.integer("run.frames"), 60);
  EXPECT_EQ(c.real("run.fps"), 60.0);
  EXPECT_EQ(c.integer2("run.size"), (Integer2{640, 480}));
  EXPECT_EQ(c.real("puddle.damping"), 0.96);
  EXPECT_EQ(c.text("puddle.blend"), "max");
  EXPECT_EQ(c.text("puddle.ground"), "tiles \"x\".png");
  EXPECT_EQ(c.real2("puddle.extent"), (Real2{2, 1}));
  EXPECT_EQ(c.real3("camera.position"), (Real3{0.1, 2, -3e-7}));
  EXPECT_FALSE(parse("effect='puddle'\nvariant='as-published'", "x.toml", {}, example_effects()).boolean("puddle.printed"));
}

TEST(Config, TakesTheDefaultOfItsVariant) {
  const auto damping = [](const std::string& variant) {
    return parse("effect='puddle'", "x.toml", {"variant=" + variant}, example_effects()).real("puddle.damping");
  };
  EXPECT_EQ(damping("as-published"), 0.99);
  EXPECT_EQ(damping("corrected"), 0.995);
}

TEST(Config, KnowsWhereAValueCameFrom) {
  const Config c = example({"run.frames=3"});
  EXPECT_EQ(c.entry("puddle.damping").origin.text(), "scenes/puddle/x.toml:9:1");
  EXPECT_EQ(c.entry("run.frames").origin.text(), "--set");
  EXPECT_EQ(c.entry("run.fps").origin.text(), "default");
  EXPECT_TRUE(c.given("puddle.damping"));
  EXPECT_TRUE(c.given("run.frames"));
  EXPECT_FALSE(c.given("run.fps"));
  EXPECT_EQ(c.directory(), "scenes/puddle");
}

TEST(Config, AskingForWhatIsNotThereIsADefect) {
  const Config c = example();
  EXPECT_EQ(error_of([&] { c.real("puddle.dampng"); }), "5 configuration: no parameter 'puddle.dampng' here");
  EXPECT_EQ(error_of([&] { c.boolean("puddle.printed"); }), "5 configuration: no parameter 'puddle.printed' here");
  EXPECT_EQ(error_of([&] { c.given("x"); }), "5 configuration: no parameter 'x' here");
  EXPECT_EQ(error_of([&] { c.integer("puddle.damping"); }), "5 configuration: 'puddle.damping' is real, asked for as integer");
  EXPECT_EQ(error_of([&] { c.real("seed"); }), "5 configuration: 'seed' is integer, asked for as real");
  EXPECT_EQ(error_of([&] { c.real3("puddle.extent"); }), "5 configuration: 'puddle.extent' is real2, asked for as real3");
}

TEST(Config, RefusesEntriesThatItsParametersRefuse) {
  const auto construct = [] { Config({{real("a", "m", 0, 1, 0, "s"), 2.0, {}}}, ""); };
  EXPECT_EQ(error_of(construct), "5 configuration: 'a' expects a number from 0 to 1 [m], found 2.0");
  EXPECT_EQ(error_of([] { Config({}, ""); }), "5 configuration: no parameter 'effect' here");
}

TEST(Config, IteratesInTheOrderOfDeclarationOverWhatTheVariantUses) {
  std::vector<std::string> keys;
  const Config c = example();
  for (const Config::Entry& e : c.entries()) keys.push_back(e.parameter.key);
  EXPECT_THAT(keys, testing::ElementsAre("effect", "variant", "seed", "run.frames", "run.fps", "run.size", "run.supersample",
                                         "puddle.damping", "puddle.drop_count", "puddle.wave_speed", "puddle.blend", "puddle.ground",
                                         "puddle.extent", "camera.position"));
}

TEST(Config, CanonicalTextListsEveryValue) {
  EXPECT_EQ(example().canonical_text(), R"(effect = "puddle"
variant = "corrected"
seed = 9223372036854775807
run.frames = 60
run.fps = 60.0
run.size = [640, 480]
run.supersample = 1
puddle.damping = 0.96
puddle.drop_count = 10
puddle.wave_speed = 0.25
puddle.blend = "add"
puddle.ground = "tiles \"x\".png"
puddle.extent = [2.0, 1.0]
camera.position = [0.1, 2.0, -3e-07]
)");
}

TEST(Config, CanonicalTextDoesNotDependOnWhereValuesCameFrom) {
  EXPECT_EQ(example({"puddle.damping=0.96", "run.fps=60"}).canonical_text(), example().canonical_text());
  EXPECT_NE(example({"puddle.damping=0.97"}).canonical_text(), example().canonical_text());
}

TEST(Config, CanonicalTextIsASceneThatLoadsAsTheSameConfiguration) {
  const std::string canonical = example().canonical_text();
  EXPECT_EQ(parse(canonical, "y.toml", {}, example_effects()).canonical_text(), canonical);
}

TEST(Config, RealsSurviveTheRoundTripBitForBit) {
  for (const char* number : {"0.1", "5e-324", "2.2250738585072014e-308", "1.7976931348623157e308", "123456789.12345679",
                             "0.30000000000000004", "1", "9007199254740993"}) {
    const double exact = std::strtod(number, nullptr);
    const Config c = example({std::string("camera.position=[") + number + ", 0, -" + number + "]"});
    EXPECT_EQ(c.real3("camera.position"), (Real3{exact, 0, -exact}));
    const Config again = parse(c.canonical_text(), "y.toml", {}, example_effects());
    EXPECT_EQ(again.real3("camera.position"), (Real3{exact, 0, -exact})) << c.canonical_text();
  }
}

TEST(Config, JsonHasEveryKeyInOrder) {
  EXPECT_EQ(config_json(example()).dump(),
            R"({"effect":"puddle","variant":"corrected","seed":9223372036854775807,"run.frames":60,"run.fps":60.0,)"
            R"("run.size":[640,480],"run.supersample":1,"puddle.damping":0.96,"puddle.drop_count":10,"puddle.wave_speed":0.25,)"
            R"("puddle.blend":"add","puddle.ground":"tiles \"x\".png","puddle.extent":[2.0,1.0],)"
            R"("camera.position":[0.1,2.0,-3e-07]})");
}

TEST(Config, JsonOfOriginsSaysWhereEachValueCameFrom) {
  const auto j = origins_json(example({"run.frames=3"}));
  EXPECT_EQ(j.size(), example().entries().size());
  EXPECT_EQ(j["run.size"], "scenes/puddle/x.toml:6:1");
  EXPECT_EQ(j["run.frames"], "--set");
  EXPECT_EQ(j["run.fps"], "default");
}

}  // namespace
}  // namespace rainref::scene
