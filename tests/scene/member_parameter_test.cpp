// One line for key, unit, range, sentence and member: defaults come from the struct, scenes set the members.
#include "scene/member_parameter.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "rainref/error.h"
#include "scene/effect_table.h"
#include "scene/toml.h"

namespace rainref::scene {
namespace {

enum class Sky : std::uint8_t { clear, grey };
struct Inner {
  double depth = 0.25;
};
struct Made {
  Variant variant = Variant::corrected;
  std::uint64_t seed = 0;
  double fps = 60;
  int width = 1280, height = 720;

  int count = 7;
  std::int64_t many = 5'000'000'000;
  bool on = true;
  double speed = 1.5;
  std::array<double, 2> pair{1, 2};
  std::array<double, 3> triple{3, 4, 5};
  std::array<int, 2> grid{6, 8};
  Sky sky = Sky::grey;
  bool fast = false;
  Rounding rounding = Rounding::rtz;
  Format format = Format::rg32f;
  Inner inner;

  bool operator==(const Made& o) const {
    return variant == o.variant && seed == o.seed && fps == o.fps && width == o.width && height == o.height && count == o.count &&
           many == o.many && on == o.on && speed == o.speed && pair == o.pair && triple == o.triple && grid == o.grid && sky == o.sky &&
           fast == o.fast && rounding == o.rounding && format == o.format && inner.depth == o.inner.depth;
  }
};

const std::vector<MemberParameter<Made>>& members() {
  static const std::vector<MemberParameter<Made>> table{
      integer<&Made::count>("made.count", "1", 0, 9, "Count.").published(std::int64_t{2}),
      integer<&Made::many>("made.many", "1", 0, 1e12, "Many."),
      boolean<&Made::on>("made.on", "On."),
      real<&Made::speed>("made.speed", "m/s", 0, 10, "Speed.").published(0.5),
      real<&Made::pair>("made.pair", "m", 0, 10, "Pair."),
      real<&Made::triple>("made.triple", "m", 0, 10, "Triple.").only(correct),
      integer<&Made::grid>("made.grid", "texel", 1, 99, "Grid."),
      choice<&Made::sky>("made.sky", {{"clear", Sky::clear}, {"grey", Sky::grey}}, "Sky."),
      choice<&Made::fast>("made.way", {{"fast", true}, {"exact", false}}, "Way."),
      rounding<&Made::rounding>("made.rounding"),
      storage<&Made::format>("made.format", {Format::rg16f, Format::rg32f}, "Format."),
      real<&Made::inner, &Inner::depth>("made.depth", "m", 0, 1, "Depth."),
      text("made.image", "", "A file; the caller reads it."),
  };
  return table;
}
Config config_of(Variant variant, const std::vector<std::string>& overrides) {
  static const std::vector<Parameter> parameters = parameters_of(members());
  const EffectTable table{{{"made", {"as-published", "corrected"}, parameters}}};
  return parse(fmt::format("effect = 'made'\nvariant = '{}'\n", name(variant)), "made", overrides, table);
}

TEST(MemberParameter, ATableIsSound) {
  const std::vector<std::string> variants{published, correct};
  validate(parameters_of(members()), variants);
}

TEST(MemberParameter, DefaultsAreTheStructs) {
  EXPECT_EQ(settings_from(members(), config_of(Variant::corrected, {})), Made{});
  EXPECT_EQ(default_settings(members(), Variant::corrected), Made{});
  Made as_published;
  as_published.variant = Variant::as_published;
  as_published.count = 2;
  as_published.speed = 0.5;
  EXPECT_EQ(settings_from(members(), config_of(Variant::as_published, {})), as_published);
  EXPECT_EQ(default_settings(members(), Variant::as_published), as_published);
  const Parameter& count = members()[0].parameter;
  EXPECT_EQ(std::get<std::int64_t>(count.default_in("as-published")), 2);
  EXPECT_EQ(std::get<std::int64_t>(count.default_in("corrected")), 7);
}

TEST(MemberParameter, AnySceneSetsItsMember) {
  Made made;
  made.seed = 9;
  made.fps = 25;
  made.width = 3;
  made.height = 2;
  made.count = 1;
  made.many = 6'000'000'000;
  made.on = false;
  made.speed = 2.5;
  made.pair = {0.5, 0.25};
  made.triple = {1, 2, 3};
  made.grid = {33, 44};
  made.sky = Sky::clear;
  made.fast = true;
  made.rounding = Rounding::rne;
  made.format = Format::rg16f;
  made.inner.depth = 0.75;
  const std::vector<std::string> said{
      "seed=9",         "run.fps=25",     "run.size=[3, 2]",       "made.count=1",          "made.many=6000000000",
      "made.on=false",  "made.speed=2.5", "made.pair=[0.5, 0.25]", "made.triple=[1, 2, 3]", "made.grid=[33, 44]",
      "made.sky=clear", "made.way=fast",  "made.rounding=rne",     "made.format=rg16f",     "made.depth=0.75"};
  EXPECT_EQ(settings_from(members(), config_of(Variant::corrected, said)), made);
}

TEST(MemberParameter, RangesAndChoicesHold) {
  for (const char* wrong : {"made.count=10", "made.depth=2", "made.sky=blue", "made.format=rgba8", "made.triple=[1, 2, 30]"})
    EXPECT_THROW(config_of(Variant::corrected, {wrong}), Error) << wrong;
  EXPECT_THROW(config_of(Variant::as_published, {"made.triple=[1, 2, 3]"}), Error) << "of the other variant";
}

}  // namespace
}  // namespace rainref::scene
