// --set: values from the command line.
#include "scene/example_effect.h"
#include "scene/toml.h"

namespace rainref::scene {
namespace {

using testing::StartsWith;

const std::string head = "effect = \"puddle\"\nvariant = \"corrected\"\n";

TEST(Overrides, AreTomlValues) {
  const auto with = [](const std::string& o) { return parse(head, "x.toml", {o}, example_effects()); };
  EXPECT_EQ(with("puddle.damping=0.96").real("puddle.damping"), 0.96);
  EXPECT_EQ(with(" puddle.damping = 0.96 ").real("puddle.damping"), 0.96);
  EXPECT_EQ(with("run.size=[64, 48]").integer2("run.size"), (Integer2{64, 48}));
  EXPECT_EQ(with("seed=0xff").integer("seed"), 255);
  EXPECT_EQ(with("variant=\"as-published\"").variant(), "as-published");
}

TEST(Overrides, TextAndChoicesMayBeBare) {
  const auto ground = [](const std::string& v) {
    return parse(head, "x.toml", {"puddle.ground=" + v}, example_effects()).text("puddle.ground");
  };
  EXPECT_EQ(ground("tiles/a b.png"), "tiles/a b.png");
  EXPECT_EQ(ground("\"a.png\""), "a.png");
  EXPECT_EQ(ground("3"), "3");
  EXPECT_EQ(ground("true"), "true");
  EXPECT_EQ(ground("a=b#c\\d\"e"), "a=b#c\\d\"e");
  EXPECT_EQ(ground(""), "");
  EXPECT_EQ(ground("1\nseed = 3"), "1\nseed = 3") << "one value cannot smuggle in another key";
  EXPECT_EQ(ground(std::string(100, '.')), std::string(100, '.'));
  EXPECT_EQ(parse(head, "x.toml", {"puddle.blend=max"}, example_effects()).text("puddle.blend"), "max");
}

TEST(Overrides, WinOverTheFileAndTheLastWins) {
  const Config c = parse(head + "seed = 1", "x.toml", {"seed=2", "seed=3"}, example_effects());
  EXPECT_EQ(c.integer("seed"), 3);
}

TEST(Overrides, MayDecideTheVariantAndTheEffect) {
  const std::string file = head + "puddle.wave_speed = 1";
  EXPECT_EQ(error_of([&] { parse(file, "x.toml", {"variant=as-published"}, example_effects()); }),
            "2 x.toml:3:8: puddle.wave_speed: not used by variant 'as-published', only by 'corrected'");
  EXPECT_EQ(parse("", "x.toml", {"effect=windshield", "variant=corrected"}, example_effects()).effect(), "windshield");
}

TEST(Overrides, DoNotHideAProblemInTheFile) {
  EXPECT_EQ(error_of([&] { parse(head + "seed = -1", "x.toml", {"seed=2"}, example_effects()); }),
            "2 x.toml:3:8: seed: expected an integer from 0 to 9223372036854775807, found -1");
}

TEST(Overrides, ErrorsNameTheOption) {
  const auto error = [](const std::string& o) { return error_of([&] { parse(head, "x.toml", {o}, example_effects()); }); };
  EXPECT_EQ(error("puddle.dampng=0.99"), "2 --set puddle.dampng: unknown key; did you mean 'puddle.damping'?");
  EXPECT_EQ(error("puddle.printed=true"), "2 --set puddle.printed: not used by variant 'corrected', only by 'as-published'");
  EXPECT_EQ(error("puddle.damping=2.5"), "2 --set puddle.damping: expected a number from 0.95 to 0.999 [1], found 2.5");
  EXPECT_EQ(error("puddle.damping=high"), "2 --set puddle.damping: expected a number from 0.95 to 0.999 [1], found \"high\"");
  EXPECT_EQ(error("puddle.damping="), "2 --set puddle.damping: expected a number from 0.95 to 0.999 [1], found \"\"");
  EXPECT_EQ(error("run.frames=1\nseed=3"), "2 --set run.frames: expected an integer from 1 to 1000000 [frame], found \"1\\nseed=3\"");
  EXPECT_EQ(error("run.size=[64, 0]"), "2 --set run.size: expected 2 integers from 1 to 65536 [texel], found [64, 0]");
  EXPECT_EQ(error("puddle.blend=mux"), "2 --set puddle.blend: expected one of 'add', 'max', found \"mux\"; did you mean 'max'?");
  EXPECT_EQ(error("variant=corected"),
            "2 --set variant: expected one of 'as-published', 'corrected', found \"corected\"; did you mean "
            "'corrected'?");
  EXPECT_EQ(error("puddle=1"), "2 --set puddle: unknown key; `rainref describe puddle puddle` lists that group");
  EXPECT_EQ(error("puddle.ground=\xff"), "2 --set puddle.ground: expected text, found bytes that are not UTF-8");
  EXPECT_EQ(error("seed"), "2 --set seed: expected key=value");
  EXPECT_EQ(error("=3"), "2 --set =3: expected key=value");
  EXPECT_EQ(error(" =3"), "2 --set  =3: expected key=value");
  EXPECT_EQ(error(""), "2 --set : expected key=value");
}

TEST(Overrides, DeepNestingIsAnErrorNotACrash) {
  std::string deep = "{";
  for (int i = 0; i < 60000; ++i) deep += "a.";
  EXPECT_THAT(error_of([&] { parse(head, "x.toml", {"seed=" + deep + "a=1}"}, example_effects()); }),
              StartsWith("2 --set seed: expected an integer from 0 to 9223372036854775807, found \"{a.a."));
}

}  // namespace
}  // namespace rainref::scene
