// The presets that come with rainref: they say keys that their effects have, and show the weather that they are named after.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "rainref/simulation.h"
#include "scene/toml.h"
#include "scene/value_text.h"
#include "simulation/opened.h"
#include "simulation/own_scenes.h"
#include "simulation/preset_texts.h"
#include "simulation/small_scenes.h"

namespace rainref::simulation {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

std::vector<std::string> names_of(const std::vector<scene::Preset>& presets) {
  std::vector<std::string> names;
  for (const scene::Preset& p : presets) names.push_back(p.name);
  return names;
}
const scene::Preset& preset(const std::string& name) {
  static const std::vector<scene::Preset> all = known_presets();
  return *std::find_if(all.begin(), all.end(), [&](const scene::Preset& p) { return p.name == name; });
}
scene::Config config_with(const std::string& presets, const std::string& effect, std::vector<std::string> set = {}) {
  set.insert(set.begin(), {"effect=" + effect, "variant=corrected"});
  if (!presets.empty()) set.push_back("preset=" + presets);
  return scene::parse("", "none.toml", set, effect_table());
}

TEST(Presets, AreWeatherThenLight) {
  EXPECT_THAT(names_of(known_presets()), ElementsAre("drizzle", "rain", "storm", "after_the_rain", "tunnel", "day", "night"));
  for (const std::string& effect : effect_table().names())
    for (const std::string name : {"drizzle", "rain", "storm", "night"}) EXPECT_TRUE(preset(name).keys.contains(effect)) << name << effect;
  EXPECT_THAT(names_of(known_presets("edge_splash")), testing::Not(testing::Contains("tunnel")));
}

// A key that says what every scene has anyhow, whatever the other presets of its kind say, would do nothing. An empty text takes away what
// a scene names: key frames, a picture.
TEST(Presets, EachKeyIsOneOfItsEffectInItsRangeAndDoesSomething) {
  for (const scene::Preset& p : known_presets()) {
    std::set<std::string> idle, busy;
    for (const auto& [effect, keys] : p.keys) {
      SCOPED_TRACE(p.name + " of " + effect);
      ASSERT_NO_THROW(config_with(p.name, effect));
      EXPECT_EQ(preset_texts(p, effect).size(), keys.size());
      const scene::Config with = config_with(p.name, effect);
      for (const scene::RawEntry& e : keys) {
        const scene::Config::Entry& entry = with.entry(e.key);
        bool differs = entry.value != entry.parameter.default_in("corrected") || entry.value == scene::Value(std::string());
        for (const scene::Preset& other : known_presets(effect))
          if (other.kind == p.kind) differs = differs || config_with(other.name, effect).entry(e.key).value != entry.value;
        (differs ? busy : idle).insert(e.key);
        EXPECT_THAT(entry.origin.text(), HasSubstr("presets/" + p.name + ".toml:"));
      }
    }
    for (const std::string& key : idle) EXPECT_TRUE(busy.contains(key)) << p.name << ": " << key;
  }
}

// src/web/scene_index.mjs reads these lines and no other TOML.
TEST(Presets, HaveTheLinesThatThePageReads) {
  const std::regex line(R"((#.*)?|\[[a-z_]+\]|[a-z_.0-9]+ = ("[^"]*"|\[[-0-9., ]+\]|-?[0-9.]+|true|false))");
  for (const scene::Preset& p : known_presets()) {
    std::istringstream text(contents(effect_table().presets / (p.name + ".toml")));
    for (std::string l; std::getline(text, l);) EXPECT_TRUE(std::regex_match(l, line)) << p.name << ": " << l;
  }
}

TEST(Presets, EachGoesOverEveryCorrectedSceneOfItsEffects) {
  int tried = 0;
  for (const std::string& name : own_scenes()) {
    const std::filesystem::path file = own_scene(name);
    const scene::Config alone = scene::load(file, {}, effect_table());
    if (alone.variant() != "corrected") continue;
    for (const scene::Preset& p : known_presets(alone.effect())) {
      EXPECT_NO_THROW(memory_of(scene::load(file, {"preset=" + p.name}, effect_table()))) << name << " " << p.name;
      ++tried;
    }
  }
  EXPECT_GT(tried, 100);
}

TEST(Presets, ComeAfterTheSceneAndBeforeOtherOverrides) {
  const std::string scene = "effect = 'puddle'\nvariant = 'corrected'\nrain.rate = 1\npuddle.damping = 0.9\npuddle.tint = [0, 0, 0]\n";
  const auto load = [&](const std::vector<std::string>& set) { return scene::parse(scene, "x.toml", set, effect_table()); };
  const double of_storm = config_with("storm", "puddle").real("rain.rate");
  EXPECT_EQ(load({"preset=storm"}).real("rain.rate"), of_storm);
  EXPECT_EQ(load({"preset=storm"}).real3("puddle.tint")[0], 0);
  EXPECT_EQ(load({"rain.rate=3", "preset=storm"}).real("rain.rate"), 3);
  EXPECT_EQ(load({"preset=storm", "rain.rate=3"}).real("rain.rate"), 3);
  EXPECT_EQ(load({"preset=drizzle", "preset=storm"}).real("rain.rate"), of_storm);
  EXPECT_EQ(load({"preset=storm, night"}).real("display.exposure"), config_with("night", "puddle").real("display.exposure"));
  // What is stored with a picture are keys alone.
  EXPECT_THAT(load({"preset=storm"}).canonical_text(), testing::Not(HasSubstr("preset")));
}

TEST(Presets, WrongNamesAreRefused) {
  const auto said = [](const std::string& presets, const std::string& effect, const std::string& variant = "corrected") {
    const std::vector<std::string> set{"effect=" + effect, "variant=" + variant, "preset=" + presets};
    const std::string error = error_of([&] { scene::parse("", "x.toml", set, effect_table()); });
    EXPECT_EQ(error.substr(0, 2), "2 ");
    return error.substr(2);
  };
  EXPECT_EQ(said("strom", "puddle"),
            "--preset: expected one of drizzle, rain, storm, after_the_rain, tunnel, day, night, found 'strom'; did you mean 'storm'?");
  EXPECT_THAT(said("after the rain", "puddle"), EndsWith("; did you mean 'after_the_rain'?"));
  EXPECT_THAT(said("", "puddle"), EndsWith("found ''"));
  EXPECT_THAT(said("storm,", "puddle"), EndsWith("found ''"));
  EXPECT_THAT(said("tunnel", "puddle"),
              testing::StartsWith("--preset: 'tunnel' does not describe puddle; expected one of drizzle, rain, storm, after_the_rain, "));
  EXPECT_EQ(said("drizzle,storm", "puddle"), "--preset: expected one preset of weather, found 'drizzle' and 'storm'");
  EXPECT_EQ(said("storm", "puddle", "as-published"), "--preset: 'storm' is for the variant 'corrected', found a scene of 'as-published'");
}

TEST(Presets, AFileThatIsNoneIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& text) {
    put(folder / "mine.toml", text);
    const std::string what = error_of([&] { scene::read_presets(folder.path()); }), begin = "2 " + (folder / "mine.toml").string();
    EXPECT_THAT(what, testing::StartsWith(begin));
    return what.substr(std::min(begin.size(), what.size()));
  };
  const std::string head = "sentence = \"Mine\"\nkind = \"weather\"\n";
  EXPECT_EQ(said("kind = \"weather\"\n"), ": sentence: missing; expected a text");
  EXPECT_EQ(said("sentence = \"Mine\"\n"), ": kind: missing; expected a text");
  EXPECT_EQ(said("sentence = \"Mine\"\nkind = \"wether\"\n"), ":2:8: kind: expected \"weather\" or \"light\", found \"wether\"");
  EXPECT_EQ(said(head + "order = 1.5\n"), ":3:9: order: expected a whole number, found 1.5");
  EXPECT_THAT(said(head + "kid = 1\n"), HasSubstr("kid: unknown key of a preset; expected one of kind, order, sentence"));
  put(folder / "mine.toml", head + "[puddle]\nrain.rate = 7\n");
  const std::vector<scene::Preset> read = scene::read_presets(folder.path());
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].keys.at("puddle")[0].key, "rain.rate");
  EXPECT_THAT(scene::read_presets(folder / "nowhere"), testing::IsEmpty());
}

// ---- what they show ----

/// A scene like its effect's default, small.
SceneText small_default(const std::string& effect, const std::string& presets, std::vector<std::string> more = {}) {
  SceneText scene = read_scene(effect + "/default.toml", {"run.size=[128, 72]", "run.supersample=1"});
  if (!presets.empty()) scene.set.push_back("preset=" + presets);
  if (effect == "puddle") more.insert(more.end(), {"environment.image=" + tiny_picture(), "puddle.ground_image=" + tiny_picture()});
  if (effect == "windshield") more.insert(more.end(), {"windshield.height_size=[512, 292]", "scene.size=[128, 72]"});
  if (effect == "screen_drops") more.insert(more.end(), {"flow.warm_up=8", "scene.image=" + tiny_picture()});
  if (effect == "rainy_glass") more.insert(more.end(), {"maps.size=256", "scene.image=" + tiny_picture()});
  scene.set.insert(scene.set.end(), more.begin(), more.end());
  return scene;
}
/// The same place without a drop.
std::vector<std::string> dry(const std::string& effect) {
  const std::map<std::string, std::vector<std::string>> keys{{"puddle", {"rain.rate=0"}},
                                                             {"windshield", {"rain.rate=0", "falling_rain.on=false"}},
                                                             {"edge_splash", {"edge_splash.drop_alpha=0"}},
                                                             {"screen_drops", {"drops.share=0", "flow.on=false"}},
                                                             {"rainy_glass", {"rain.amount=0", "rain.rivulet_amount=0"}}};
  return keys.at(effect);
}
/// Share of the pixels that water changes by 3 codes or more, in the last of these frames.
double share_of_wet(const std::string& effect, const std::string& presets, int frames) {
  const parallel::Executor executor(2);
  Simulation wet(small_default(effect, presets), executor), without(small_default(effect, presets, dry(effect)), executor);
  for (int frame = 0; frame < frames; ++frame) {
    wet.next_frame();
    without.next_frame();
  }
  const Image &a = wet.picture(), &b = without.picture();
  int changed = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < 4 * a.width(); x += 4) {
      int most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(int(a.row_bytes(y)[x + c]) - int(b.row_bytes(y)[x + c])));
      changed += most >= 3;
    }
  return double(changed) / (a.width() * a.height());
}

class Weather : public testing::TestWithParam<std::string> {};

TEST_P(Weather, GrowsFromDrizzleToStorm) {
  const auto share = [](const char* preset) { return share_of_wet(GetParam(), preset, 45); };
  const double drizzle = share("drizzle"), rain = share("rain"), storm = share("storm");
  RecordProperty("wet", fmt::format("{:.3f} {:.3f} {:.3f}", drizzle, rain, storm));
  EXPECT_GT(drizzle, 0);
  EXPECT_GT(rain, 1.2 * drizzle);
  EXPECT_GT(storm, 1.2 * rain);
}
INSTANTIATE_TEST_SUITE_P(Presets, Weather, testing::Values("puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"),
                         [](const auto& of) { return of.param; });

/// The drops on the glass in the last frame.
int drops_in(const Simulation& simulation, const std::string& buffer) {
  return static_cast<int>(std::get<RecordView>(simulation.buffer(buffer)).count);
}

// Marshall and Palmer: the flux of drops above a diameter grows with the rate. The rates themselves are in the order of the names; those
// of puddle and windshield are those of the weather's definitions: drizzle below 1 mm/h on the ground, heavy rain above 10, violent
// above 50.
TEST(Presets, RatesOfTheRoadAreThoseOfTheWeather) {
  EXPECT_LE(config_with("drizzle", "puddle").real("rain.rate"), 1);
  EXPECT_GE(config_with("rain", "puddle").real("rain.rate"), 2.5);
  EXPECT_LE(config_with("rain", "puddle").real("rain.rate"), 10);
  EXPECT_GE(config_with("storm", "puddle").real("rain.rate"), 50);
  for (const std::string effect : {"puddle", "windshield", "screen_drops"})
    EXPECT_LT(config_with("drizzle", effect).real("rain.rate"), config_with("rain", effect).real("rain.rate"));
}

TEST(Presets, AfterTheRainNothingFallsAndWaterIsThere) {
  const parallel::Executor executor(2);
  // The puddle is as still as a mirror.
  EXPECT_EQ(share_of_wet("puddle", "after_the_rain", 20), 0);
  // The windshield is out of the rain when it has come 6 m far: from then on drops merge, run off, and none is new.
  for (const auto& [name, metres] : {std::pair("after_the_rain", 6.0), std::pair("tunnel", 14.0)}) {
    Simulation car(small_default("windshield", name), executor);
    const double fps = 30, speed = config_with(name, "windshield").real("vehicle.speed");
    const int under = static_cast<int>(fps * metres / speed) + 5;
    int before = 0;
    for (int frame = 0; frame < under + 30; ++frame) {
      car.next_frame();
      const int now = drops_in(car, "drops");
      if (frame > under) {
        EXPECT_LE(now, before) << name << ", frame " << frame;
      }
      before = now;
    }
    EXPECT_GT(before, 100) << name;
  }
  for (const std::string effect : {"screen_drops", "rainy_glass"}) {
    EXPECT_GT(share_of_wet(effect, "after_the_rain", 2), 0.02) << effect;
    const scene::Config config = config_with("after_the_rain", effect);
    if (effect == "screen_drops") {
      EXPECT_EQ(config.real("rain.rate"), 0);
    }
  }
}

}  // namespace
}  // namespace rainref::simulation
