// A scene file is read with every key checked; a refusal names place, key and what was meant.
#include "scene/toml.h"

#include <cmath>

#include "scene/example_effect.h"
#include "scene/unexercised.h"

namespace rainref::scene {
namespace {

using testing::MatchesRegex;
using testing::StartsWith;

const std::string head = "effect = \"puddle\"\nvariant = \"corrected\"\n";

// The error of the head above followed by `rest`, whose first line is line 3.
std::string error_in(const std::string& rest) {
  return error_of([&] { parse(head + rest, "x.toml", {}, example_effects()); });
}
std::string error_of_text(const std::string& text) {
  return error_of([&] { parse(text, "x.toml", {}, example_effects()); });
}

TEST(Scene, NeedsAnEffect) {
  EXPECT_EQ(error_of_text(""), "2 x.toml: effect: missing; expected one of 'puddle', 'windshield'");
  EXPECT_EQ(error_of_text("effect = 'pudle'"),
            "2 x.toml:1:10: effect: expected one of 'puddle', 'windshield', found \"pudle\"; did you mean 'puddle'?");
  EXPECT_EQ(error_of_text("effect = 'rain'"), "2 x.toml:1:10: effect: expected one of 'puddle', 'windshield', found \"rain\"");
  EXPECT_EQ(error_of_text("effect = 3"), "2 x.toml:1:10: effect: expected one of 'puddle', 'windshield', found 3");
  EXPECT_EQ(error_of_text("[effect]\nname = 'puddle'"), "2 x.toml: effect: missing; expected one of 'puddle', 'windshield'");
}

TEST(Scene, NeedsAVariant) {
  EXPECT_EQ(error_of_text("effect = 'puddle'"), "2 x.toml: variant: missing; expected one of 'as-published', 'corrected'");
  EXPECT_EQ(error_of_text("effect = 'puddle'\nvariant = 'corected'"),
            "2 x.toml:2:11: variant: expected one of 'as-published', 'corrected', found \"corected\"; did you mean "
            "'corrected'?");
}

TEST(Scene, NeedsEachRequiredParameter) {
  const std::vector<Parameter> own{text("glass.map", "", "The map.").required()};
  const EffectTable table{{{"glass", {"corrected"}, own}}};
  const std::string text = "effect = 'glass'\nvariant = 'corrected'\n";
  EXPECT_EQ(error_of([&] { parse(text, "x.toml", {}, table); }), "2 x.toml: glass.map: missing; expected text");
  EXPECT_EQ(parse(text + "glass.map = 'a.png'", "x.toml", {}, table).text("glass.map"), "a.png");
}

TEST(Scene, TablesAndDottedKeysAreTheSame) {
  const Config tables = parse(head + "[puddle]\ndamping = 0.96\n[run]\nsize = [3, 4]", "x.toml", {}, example_effects());
  const Config dotted = parse("puddle.damping = 0.96\nrun = {size = [3, 4]}\n" + head, "x.toml", {}, example_effects());
  EXPECT_EQ(tables.canonical_text(), dotted.canonical_text());
}

TEST(Scene, AnUnknownKeyNamesTheNearest) {
  EXPECT_EQ(error_in("[puddle]\n  dampng = 0.99"), "2 x.toml:4:3: puddle.dampng: unknown key; did you mean 'puddle.damping'?");
  EXPECT_EQ(error_in("[puddl]\ndamping = 0.99"), "2 x.toml:4:1: puddl.damping: unknown key; did you mean 'puddle.damping'?");
  EXPECT_EQ(error_in("zebra = 1"), "2 x.toml:3:1: zebra: unknown key");
}

// It changes nothing of the scene.
TEST(Scene, SaysWhyAlternativesAreNotExercised) {
  const std::string table = "[unexercised]\nshade = [['a', 'no shore'], ['b', 'x']]\n";
  EXPECT_EQ(parse(head + table, "x.toml", {}, example_effects()).canonical_text(),
            parse(head, "x.toml", {}, example_effects()).canonical_text());
  EXPECT_EQ(unexercised(head + table, "x.toml"), (Unexercised{{"shade", {{"a", "no shore"}, {"b", "x"}}}}));
  EXPECT_EQ(unexercised(head, "x.toml"), Unexercised());
  const std::string expected = "unexercised.shade: expected pairs of an alternative and the reason why no run takes it, found ";
  EXPECT_EQ(error_in("unexercised.shade = 'a'"), "2 x.toml:3:21: " + expected + "\"a\"");
  EXPECT_EQ(error_in("unexercised.shade = [['a']]"), "2 x.toml:3:22: " + expected + "[\"a\"]");
  EXPECT_EQ(error_in("unexercised.shade = [['a', 3]]"), "2 x.toml:3:22: " + expected + "[\"a\", 3]");
  EXPECT_EQ(error_in("unexercised.shade = [['a', '']]"), "2 x.toml:3:22: " + expected + "[\"a\", \"\"]");
  EXPECT_EQ(error_in("unexercised.shade = [['a', 'b'], ['a', 'c']]"), "2 x.toml:3:34: unexercised.shade: 'a' is there twice");
}

TEST(Scene, AKeyInTheWrongTableNamesTheRightOne) {
  EXPECT_EQ(error_in("frames = 10"), "2 x.toml:3:1: frames: unknown key; did you mean 'run.frames'?");
  EXPECT_EQ(error_in("[camera]\ndrop_count = 10"), "2 x.toml:4:1: camera.drop_count: unknown key; did you mean 'puddle.drop_count'?");
  EXPECT_EQ(error_in("[camera]\ndrop_cuont = 10"), "2 x.toml:4:1: camera.drop_cuont: unknown key; did you mean 'puddle.drop_count'?");
}

TEST(Scene, AQuotedKeyIsAnotherKey) {
  EXPECT_EQ(error_in("\"puddle.damping\" = 0.99"), "2 x.toml:3:1: \"puddle.damping\": unknown key; did you mean 'puddle.damping'?");
  EXPECT_EQ(error_in("\"a\\nb\" = 1"), "2 x.toml:3:1: \"a\\nb\": unknown key");
}

TEST(Scene, AnEmptyTableMustBeKnown) {
  EXPECT_EQ(error_in("[puddle]"), "none");
  EXPECT_EQ(error_in("[pudle]"), "2 x.toml:3:2: pudle: unknown table; did you mean 'puddle'?");
  EXPECT_EQ(error_in("[zebra]"), "2 x.toml:3:2: zebra: unknown table");
  EXPECT_EQ(error_in("[puddle.damping]"), "2 x.toml:3:1: puddle.damping: expected a number from 0.95 to 0.999 [1], found a table");
}

TEST(Scene, AKeyOfAnotherVariantSaysSoAndIsNotSuggested) {
  EXPECT_EQ(error_in("puddle.printed = true"), "2 x.toml:3:8: puddle.printed: not used by variant 'corrected', only by 'as-published'");
  EXPECT_EQ(error_in("puddle.prnted = true"), "2 x.toml:3:8: puddle.prnted: unknown key");
}

TEST(Scene, AValueOutOfRangeIsRefused) {
  EXPECT_EQ(error_in("puddle.damping = 2.5"), "2 x.toml:3:18: puddle.damping: expected a number from 0.95 to 0.999 [1], found 2.5");
  EXPECT_EQ(error_in("puddle.damping = 2"), "2 x.toml:3:18: puddle.damping: expected a number from 0.95 to 0.999 [1], found 2");
  EXPECT_EQ(error_in("run.frames = 0"), "2 x.toml:3:14: run.frames: expected an integer from 1 to 1000000 [frame], found 0");
  EXPECT_EQ(error_in("seed = -1"), "2 x.toml:3:8: seed: expected an integer from 0 to 9223372036854775807, found -1");
  EXPECT_EQ(error_in("run.fps = 1000.5"), "2 x.toml:3:11: run.fps: expected a number from 1 to 1000 [1/s], found 1000.5");
}

TEST(Scene, WhatIsNotFiniteIsRefused) {
  EXPECT_EQ(error_in("puddle.wave_speed = inf"), "2 x.toml:3:21: puddle.wave_speed: expected a number of at least 0 [m/s], found inf");
  EXPECT_EQ(error_in("puddle.wave_speed = nan"), "2 x.toml:3:21: puddle.wave_speed: expected a number of at least 0 [m/s], found nan");
  EXPECT_EQ(error_in("camera.position = [0, -inf, 0]"), "2 x.toml:3:23: camera.position: expected 3 numbers [m], found [0, -inf, 0]");
}

TEST(Scene, AnIntegerIsTakenAsARealNeverTheReverse) {
  EXPECT_EQ(parse(head + "run.fps = 30", "x.toml", {}, example_effects()).real("run.fps"), 30.0);
  EXPECT_EQ(error_in("run.frames = 3.0"), "2 x.toml:3:14: run.frames: expected an integer from 1 to 1000000 [frame], found 3.0");
  EXPECT_EQ(error_in("run.size = [640, 480.0]"),
            "2 x.toml:3:18: run.size: expected 2 integers from 1 to 65536 [texel], found [640, 480.0]");
}

TEST(Scene, AValueOfAnotherTypeIsRefused) {
  EXPECT_EQ(error_in("puddle.damping = '0.99'"), "2 x.toml:3:18: puddle.damping: expected a number from 0.95 to 0.999 [1], found \"0.99\"");
  EXPECT_EQ(error_in("run.frames = true"), "2 x.toml:3:14: run.frames: expected an integer from 1 to 1000000 [frame], found true");
  EXPECT_EQ(error_in("puddle.ground = 3"), "2 x.toml:3:17: puddle.ground: expected text, found 3");
  EXPECT_EQ(error_in("puddle.ground = 1979-05-27"), "2 x.toml:3:17: puddle.ground: expected text, found a date or time");
  EXPECT_EQ(error_of_text("effect = 'puddle'\nvariant = 'as-published'\npuddle.printed = 1"),
            "2 x.toml:3:18: puddle.printed: expected true or false, found 1");
  EXPECT_EQ(error_in("puddle = 3"), "2 x.toml:3:10: puddle: expected a table, found 3");
  EXPECT_EQ(error_in("[[puddle]]\ndamping = 0.99"), "2 x.toml:3:1: puddle: expected a table, found [a table]");
}

TEST(Scene, AnArrayOfTheWrongLengthIsRefused) {
  EXPECT_EQ(error_in("run.size = [640, 480, 1]"),
            "2 x.toml:3:12: run.size: expected 2 integers from 1 to 65536 [texel], found [640, 480, 1]");
  EXPECT_EQ(error_in("run.size = 640"), "2 x.toml:3:12: run.size: expected 2 integers from 1 to 65536 [texel], found 640");
  EXPECT_EQ(error_in("puddle.damping = [0.99]"), "2 x.toml:3:18: puddle.damping: expected a number from 0.95 to 0.999 [1], found [0.99]");
  EXPECT_EQ(error_in("camera.position = [\n 1,\n [2],\n 3]"), "2 x.toml:5:2: camera.position: expected 3 numbers [m], found [1, [2], 3]");
}

TEST(Scene, AComponentOutOfRangeIsPointedAt) {
  EXPECT_EQ(error_in("run.size = [640, 0]"), "2 x.toml:3:18: run.size: expected 2 integers from 1 to 65536 [texel], found [640, 0]");
  EXPECT_EQ(error_in("puddle.extent = [0.05, 1]"), "2 x.toml:3:18: puddle.extent: expected 2 numbers from 0.1 to 100 [m], found [0.05, 1]");
}

TEST(Scene, AnUnknownChoiceNamesTheNearest) {
  EXPECT_EQ(error_in("puddle.blend = 'mux'"),
            "2 x.toml:3:16: puddle.blend: expected one of 'add', 'max', found \"mux\"; did you mean 'max'?");
  EXPECT_EQ(error_in("puddle.blend = 'subtract'"), "2 x.toml:3:16: puddle.blend: expected one of 'add', 'max', found \"subtract\"");
}

TEST(Scene, NegativeZeroBecomesZero) {
  const Config c = parse(head + "camera.position = [-0.0, 0.0, -0.0]", "x.toml", {}, example_effects());
  for (const double v : c.real3("camera.position")) EXPECT_FALSE(std::signbit(v));
}

TEST(Scene, TheFirstProblemInTheFileIsReported) {
  // Sorted by name, [camera] would come first.
  EXPECT_THAT(error_in("[puddle]\ndamping = 3\n[camera]\nposition = 1"), StartsWith("2 x.toml:4:11: puddle.damping: "));
  EXPECT_THAT(error_in("[run]\nfps = 0\nframes = 0"), StartsWith("2 x.toml:4:7: run.fps: "));
}

TEST(Scene, AnErrorOfSyntaxHasItsPlaceAndIsOneLine) {
  // Words and columns are the library's.
  EXPECT_THAT(error_in("[puddle]\ndamping = \n"), MatchesRegex("2 x.toml:4:[0-9]+: [^\n]*expected value[^\n]*"));
  EXPECT_THAT(error_in("seed = 1\nseed = 2\n"), MatchesRegex("2 x.toml:4:[0-9]+: [^\n]*redefine[^\n]*'seed'"));
  EXPECT_THAT(error_in("seed = 99999999999999999999"),
              MatchesRegex("2 x.toml:3:[0-9]+: [^\n]*'99999999999999999999' is not representable in 64 bits"));
  EXPECT_THAT(error_in("a = '\xff'"), MatchesRegex("2 x.toml:3:[0-9]+: [^\n]*utf-8[^\n]*"));
  EXPECT_THAT(error_in("[x\ny = 1"), MatchesRegex("2 x.toml:3:[0-9]+: [^\n]*"));
}

}  // namespace
}  // namespace rainref::scene
