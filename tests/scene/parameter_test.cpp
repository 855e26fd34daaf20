// A parameter accepts its type in its range, and tables that contradict themselves are refused.
#include "scene/parameter.h"

#include <limits>

#include "scene/example_effect.h"
#include "scene/value_text.h"

namespace rainref::scene {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t last_integer = std::numeric_limits<std::int64_t>::max();
const std::vector<std::string> variants{"as-published", "corrected"};

std::string validated(const std::vector<Parameter>& table) {
  return error_of([&] { validate(table, variants); });
}

Parameter among(Parameter p, std::vector<std::string> choices) {
  p.choices = std::move(choices);
  return p;
}

TEST(Parameter, ExpectationSaysTypeRangeAndUnit) {
  EXPECT_EQ(expectation(real("a", "1", 0.95, 0.999, 0.99, "s")), "a number from 0.95 to 0.999 [1]");
  EXPECT_EQ(expectation(real("a", "m", 0, infinity, 0, "s")), "a number of at least 0 [m]");
  EXPECT_EQ(expectation(real("a", "m", -infinity, 2.5, 0, "s")), "a number of at most 2.5 [m]");
  EXPECT_EQ(expectation(real("a", "", -infinity, infinity, 0, "s")), "a number");
  EXPECT_EQ(expectation(real3("a", "m", -1, 1, {}, "s")), "3 numbers from -1 to 1 [m]");
  EXPECT_EQ(expectation(real2("a", "m", -infinity, infinity, {}, "s")), "2 numbers [m]");
  EXPECT_EQ(expectation(integer("a", "", 0, 9223372036854775807.0, 0, "s")), "an integer from 0 to 9223372036854775807");
  EXPECT_EQ(expectation(integer2("a", "texel", 1, 65536, {1, 1}, "s")), "2 integers from 1 to 65536 [texel]");
  EXPECT_EQ(expectation(boolean("a", true, "s")), "true or false");
  EXPECT_EQ(expectation(choice("a", {"add", "max"}, "add", "s")), "one of 'add', 'max'");
  EXPECT_EQ(expectation(text("a", "", "s")), "text");
}

TEST(Parameter, AcceptsItsTypeInItsInclusiveRange) {
  const Parameter p = real("a", "1", -1, 2, 0, "s");
  EXPECT_TRUE(accepts(p, -1.0));
  EXPECT_TRUE(accepts(p, 2.0));
  EXPECT_FALSE(accepts(p, 2.0000000001));
  EXPECT_FALSE(accepts(p, nan_value));
  EXPECT_FALSE(accepts(p, std::int64_t{1}));
  const Parameter v = real3("a", "1", -1, 2, {}, "s");
  EXPECT_TRUE(accepts(v, Real3{-1, 0, 2}));
  EXPECT_FALSE(accepts(v, Real3{0, 0, 3}));
  EXPECT_FALSE(accepts(v, Real2{0, 0}));
}

// As the samples of a traced pixel, which have patterns for some numbers alone.
TEST(Parameter, AnIntegerMayHaveChoices) {
  const Parameter p = among(integer("a", "1", 1, 16, 1, "s"), {"1", "4", "8", "16"});
  EXPECT_EQ(expectation(p), "1, 4, 8 or 16 [1]");
  EXPECT_EQ(range_text(p), "1, 4, 8 or 16");
  for (const std::int64_t v : {1, 4, 8, 16}) EXPECT_TRUE(accepts(p, v)) << v;
  for (const std::int64_t v : {0, 2, 15, 17, 32}) EXPECT_FALSE(accepts(p, v)) << v;
  EXPECT_FALSE(accepts(p, std::string("4")));
  EXPECT_EQ(validated({p}), "none");
}

TEST(Parameter, AnUnboundedRealStillRefusesWhatIsNotFinite) {
  const Parameter p = real("a", "1", -infinity, infinity, 0, "s");
  EXPECT_TRUE(accepts(p, -1e300));
  EXPECT_FALSE(accepts(p, infinity));
  EXPECT_FALSE(accepts(p, -infinity));
  EXPECT_FALSE(accepts(p, nan_value));
}

TEST(Parameter, IntegersAreComparedExactly) {
  const std::int64_t beyond = (std::int64_t{1} << 53) + 1;  // rounds to 2^53 as a double
  EXPECT_FALSE(accepts(integer("a", "", 0, 9007199254740992.0, 0, "s"), beyond));
  EXPECT_TRUE(accepts(integer("a", "", 0, 9007199254740992.0, 0, "s"), beyond - 1));
  EXPECT_TRUE(accepts(integer("a", "", 0, 9223372036854775807.0, 0, "s"), last_integer));
  EXPECT_FALSE(accepts(integer("a", "", 0, 9223372036854775807.0, 0, "s"), std::int64_t{-1}));
  EXPECT_TRUE(accepts(integer("a", "", -infinity, infinity, 0, "s"), std::numeric_limits<std::int64_t>::min()));
  EXPECT_FALSE(accepts(integer("a", "", 0.5, 1.5, 1, "s"), std::int64_t{2}));
  EXPECT_FALSE(accepts(integer("a", "", 0.5, 1.5, 1, "s"), std::int64_t{0}));
  EXPECT_FALSE(accepts(integer("a", "", 1e30, infinity, 1, "s"), last_integer));
}

TEST(Parameter, DefaultsDependOnTheVariant) {
  const Parameter p = real("a", "1", 0, 1, 0.5, "s").default_for("corrected", 1);
  EXPECT_EQ(p.default_in("as-published"), Value(0.5));
  EXPECT_EQ(p.default_in("corrected"), Value(1.0));
}

TEST(Parameter, OnlyMayNameSeveralVariants) {
  const Parameter p = real("a", "1", 0, 1, 0.5, "s").only("x").only("y");
  EXPECT_TRUE(p.used_by("x"));
  EXPECT_TRUE(p.used_by("y"));
  EXPECT_FALSE(p.used_by("z"));
  EXPECT_TRUE(real("a", "1", 0, 1, 0.5, "s").used_by("z"));
}

TEST(ValidateParameters, AcceptsTheExample) { EXPECT_EQ(validated(puddle_parameters()), "none"); }

TEST(ValidateParameters, RefusesATableThatContradictsItself) {
  const Parameter good = real("a.b", "1", 0, 1, 0.5, "s");
  EXPECT_EQ(validated({good, good}), "5 parameter 'a.b': declared twice");
  EXPECT_EQ(validated({good, real("a", "1", 0, 1, 0.5, "s")}), "5 parameter 'a': is also the table of 'a.b'");
  EXPECT_EQ(validated({real("a", "1", 0, 1, 2, "s")}), "5 parameter 'a': default 2.0, expected a number from 0 to 1 [1]");
  EXPECT_EQ(validated({good.default_for("corrected", 2.5)}),
            "5 parameter 'a.b': default 2.5 in 'corrected', expected a number from 0 to 1 [1]");
  EXPECT_EQ(validated({good.default_for("corected", 1)}), "5 parameter 'a.b': default for 'corected'");
  EXPECT_EQ(validated({good.only("corrected").default_for("as-published", 1)}), "5 parameter 'a.b': default for 'as-published'");
  EXPECT_EQ(validated({good.only("corected")}), "5 parameter 'a.b': no variant 'corected'");
  EXPECT_EQ(validated({real("a", "1", 1, 0, 0.5, "s")}), "5 parameter 'a': empty range");
  EXPECT_EQ(validated({real("a", "1", nan_value, 1, 0.5, "s")}), "5 parameter 'a': empty range");
  EXPECT_EQ(validated({real("a", "1", 0, 1, 0.5, "")}), "5 parameter 'a': no sentence");
  EXPECT_EQ(validated({choice("a", {}, "", "s")}), "5 parameter 'a': a choice has choices, an integer may have some, and nothing else has");
  EXPECT_EQ(validated({among(text("a", "", "s"), {"x"})}),
            "5 parameter 'a': a choice has choices, an integer may have some, and nothing else has");
  EXPECT_EQ(validated({among(integer("a", "", 1, 16, 2, "s"), {"1", "4"})}), "5 parameter 'a': default 2, expected 1 or 4");
  EXPECT_EQ(validated({choice("a", {"x"}, "y", "s")}), "5 parameter 'a': default \"y\", expected one of 'x'");
}

TEST(ValidateParameters, KeysAreLowerCaseWordsJoinedByDots) {
  for (const char* key : {"", ".", "a.", ".a", "a..b", "A", "a b", "1a", "a.1", "_a", "a-b"}) {
    EXPECT_EQ(validated({boolean(key, true, "s")}), std::string("5 parameter '") + key + "': malformed key");
  }
  EXPECT_EQ(validated({boolean("a1.b_2.c", true, "s")}), "none");
}

TEST(ValidateParameters, ARequiredParameterNeedsNoDefault) { EXPECT_EQ(validated({choice("a", {"x"}, "", "s").required()}), "none"); }

TEST(ValueText, IsTheShortestLiteralThatReadsBack) {
  EXPECT_EQ(value_text(true), "true");
  EXPECT_EQ(value_text(last_integer), "9223372036854775807");
  EXPECT_EQ(value_text(Integer2{640, 480}), "[640, 480]");
  EXPECT_EQ(value_text(0.1), "0.1");
  EXPECT_EQ(value_text(2.0), "2.0");
  EXPECT_EQ(value_text(-0.0), "-0.0");
  EXPECT_EQ(value_text(1e20), "1e+20");
  EXPECT_EQ(value_text(5e-324), "5e-324");
  EXPECT_EQ(value_text(1.7976931348623157e308), "1.7976931348623157e+308");
  EXPECT_EQ(value_text(Real3{1, 0.25, -3}), "[1.0, 0.25, -3.0]");
  EXPECT_EQ(value_text(std::string("a \"b\" \\ \n\t\x01 é")), R"("a \"b\" \\ \n\t\u0001 é")");
}

TEST(EffectTable, FindNamesTheNearestEffect) {
  EXPECT_EQ(example_effects().find("windshield").name, "windshield");
  EXPECT_EQ(error_of([] { example_effects().find("pudle"); }),
            "2 effect: expected one of 'puddle', 'windshield', found 'pudle'; did you mean 'puddle'?");
}

TEST(EffectTable, SceneParametersBeginWithTheCommonOnes) {
  const EffectTable table = example_effects();
  std::vector<std::string> keys;
  for (const Parameter& p : scene_parameters(table.find("puddle"), table)) keys.push_back(p.key);
  ASSERT_EQ(keys.size(), 7 + puddle_parameters().size());
  keys.resize(8);
  EXPECT_THAT(keys,
              testing::ElementsAre("effect", "variant", "seed", "run.frames", "run.fps", "run.size", "run.supersample", "puddle.damping"));
}

TEST(EffectTable, SceneParametersRefuseAnEffectThatRedeclaresACommonOne) {
  const std::vector<Parameter> own{integer("seed", "", 0, 1, 0, "Another seed.")};
  const EffectTable table{{{"bad", {"corrected"}, own}}};
  EXPECT_EQ(error_of([&] { scene_parameters(table.find("bad"), table); }), "5 parameter 'seed': declared twice");
}

}  // namespace
}  // namespace rainref::scene
