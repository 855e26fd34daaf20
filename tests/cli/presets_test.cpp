// --preset, as a user has it: every verb that takes a scene takes it, and --set goes before it.
#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::ContainsRegex;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Preset : public CommandLine {
 protected:
  /// What a preset sets in a scene, as `describe` says: words of --set.
  std::vector<std::string> sets_of(const std::string& preset, const std::string& scene) const {
    const auto with = nlohmann::json::parse(good(rainref({"describe", scene, "--preset", preset, "--json"})).out);
    std::vector<std::string> words;
    for (const auto& [key, origin] : with["origins"].items())
      if (origin.get<std::string>().find("presets/" + preset + ".toml") != std::string::npos)
        words.insert(words.end(), {"--set", key + "=" + with["values"][key].dump()});
    return words;
  }
};

TEST_F(Preset, IsItsKeys) {
  const std::vector<std::string> keys = sets_of("storm", "corrected.toml");
  EXPECT_GE(keys.size(), 6u);
  const std::vector<std::string> lines = hash({"corrected.toml", "--preset", "storm"});
  EXPECT_EQ(lines, hash(joined({"corrected.toml"}, keys)));
  EXPECT_NE(lines, hash({"corrected.toml"}));
  EXPECT_NE(lines, hash({"corrected.toml", "--preset", "rain"}));
}

TEST_F(Preset, SetGoesBeforeIt) {
  const std::vector<std::string> own{"--set", "rain.rate=3"};
  const std::vector<std::string> expected = hash(joined(joined({"corrected.toml"}, sets_of("storm", "corrected.toml")), own));
  EXPECT_EQ(hash({"corrected.toml", "--preset", "storm", "--set", "rain.rate=3"}), expected);
  EXPECT_EQ(hash({"corrected.toml", "--set", "rain.rate=3", "--preset", "storm"}), expected);
  EXPECT_NE(hash({"corrected.toml", "--preset", "storm"}), expected);
}

TEST_F(Preset, WeatherAndLightGoTogether) {
  const std::vector<std::string> both = hash({"corrected.toml", "--preset", "storm,night", "--set", "environment.image=sky.npy"});
  EXPECT_EQ(hash({"corrected.toml", "--preset", "storm", "--preset", "night", "--set", "environment.image=sky.npy"}), both);
  EXPECT_EQ(hash({"corrected.toml", "--preset", "night,storm", "--set", "environment.image=sky.npy"}), both);
  expect_refusal({"run", "corrected.toml", "--preset", "storm,drizzle"}, 2, EndsWith("found 'storm' and 'drizzle'"));
}

TEST_F(Preset, EveryVerbThatTakesASceneTakesIt) {
  for (const std::string verb : {"run", "hash", "pack", "view", "describe", "validate"})
    EXPECT_THAT(rainref({verb, "--help"}).out, HasSubstr("--preset")) << verb;
  const std::vector<std::string> storm{"--preset", "storm"};
  good(rainref(joined({"run", "corrected.toml", "-o", "out"}, storm)));
  const auto summary = nlohmann::json::parse(contents(folder / "out/summary.json"));
  const auto described = nlohmann::json::parse(rainref(joined({"describe", "corrected.toml", "--json"}, storm)).out);
  EXPECT_EQ(summary["config"]["rain.rate"], described["values"]["rain.rate"]);
  EXPECT_GT(summary["config"]["rain.rate"], 49);
  good(rainref(joined({"pack", "corrected.toml", "--at", "1", "-o", "pack"}, storm)));
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "pack/manifest.json"))["config"]["rain.rate"], summary["config"]["rain.rate"]);
  // A picture holds the keys, so it needs no preset.
  EXPECT_THAT(rainref({"describe", "out/puddle.0001.png"}).out, HasSubstr("\nrain.rate "));
  before = folder.names();
  expect_refusal({"view", "corrected.toml", "--no-browser", "--preset", "strom"}, 2, EndsWith("did you mean 'storm'?"));
  expect_refusal({"describe", "puddle", "--preset", "storm"}, 2, "--preset: expected a scene, found the effect 'puddle'");
  expect_refusal({"validate", "pack", "--port", "pack", "--preset", "storm"}, 2,
                 "--set, --preset and --size: go with --shadow and a scene only");
}

// Sweeps have one more key, which may be an axis.
TEST_F(Preset, APlanTakesThem) {
  put(folder / "plan.toml",
      "verb = 'hash'\nscene = 'corrected.toml'\n[axes]\npreset = ['drizzle', 'storm,night']\n[set]\n"
      "'environment.image' = 'sky.npy'\n");
  good(rainref({"sweep", "run", "plan.toml", "-o", "swept"}));
  good(rainref({"sweep", "collect", "plan.toml", "-o", "swept"}));
}

TEST_F(Preset, WhatItDoesNotDescribeIsRefused) {
  for (const std::string verb : {"run", "hash", "describe"}) {
    expect_refusal({verb, "corrected.toml", "--preset", "strom"}, 2,
                   StartsWith("--preset: expected one of drizzle, rain, storm, after_the_rain, tunnel, day, night, found 'strom'; did you "
                              "mean 'storm'?"));
    expect_refusal({verb, "corrected.toml", "--preset", "tunnel"}, 2, StartsWith("--preset: 'tunnel' does not describe puddle; "));
    expect_refusal({verb, "published.toml", "--preset", "storm"}, 2,
                   "--preset: 'storm' is for the variant 'corrected', found a scene of 'as-published'");
  }
}

TEST_F(Preset, ListSaysWhatEachShows) {
  const std::string all = good(rainref({"list"})).out;
  EXPECT_THAT(all, HasSubstr("\n\nPresets, for --preset: weather, light or both\n  drizzle        weather  Drizzle: "));
  EXPECT_THAT(all, ContainsRegex("\n  tunnel +weather  [^\n]+ \\(windshield"));
  EXPECT_THAT(all, ContainsRegex("\n  night +light    [^\n(]+\n"));
  EXPECT_THAT(rainref({"list", "puddle"}).out, Not(HasSubstr("\n  tunnel")));
  const auto json = nlohmann::json::parse(rainref({"list", "puddle", "--json"}).out);
  std::set<std::string> names;
  for (const auto& preset : json["presets"]) {
    names.insert(preset["name"]);
    EXPECT_NE(preset["sentence"], "");
    EXPECT_FALSE(preset["keys"]["puddle"].empty()) << preset;
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"drizzle", "rain", "storm", "after_the_rain", "night"}));
}

}  // namespace
}  // namespace rainref::cli
