// `rainref list` and `rainref describe`.
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "math/simd_target.h"
#include "scene/key_groups.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using List = CommandLine;
using Describe = CommandLine;

TEST_F(List, SaysWhatThereIs) {
  const Outcome o = rainref({"list"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  EXPECT_THAT(o.out, HasSubstr("  puddle         as-published  raindrops wave_step surface_hit ground_noise shade display\n"));
  EXPECT_THAT(o.out, HasSubstr("  puddle         corrected     raindrops wave_step surface_hit shade display\n"));
  EXPECT_THAT(o.out, HasSubstr(fmt::format("SIMD targets    {}\n", fmt::join(simd_targets(), " "))));
}

TEST_F(List, ScenesOfTheCurrentFolderComeFirst) {
  EXPECT_THAT(rainref({"list"}).out, HasSubstr("\n  puddle/default.toml  "));
  std::filesystem::create_directories(folder / "scenes/deep");
  put(folder / "scenes/deep/mine.toml", "");
  put(folder / "scenes/notes.txt", "");
  const Outcome o = rainref({"list"});
  EXPECT_THAT(o.out, HasSubstr("\nScenes\n  scenes/deep/mine.toml\n\n"));
}

// The first sentence of the comment at the top of each file, on the line of its name: `rainref list | grep mist` finds a scene.
TEST_F(List, SaysWhatASceneIs) {
  EXPECT_THAT(rainref({"list"}).out, ContainsRegex("\n  windshield/condensation[.]toml +A misty windshield in the rain: drops cut "));
  std::filesystem::create_directories(folder / "scenes");
  const std::string effect = "effect = 'puddle'\n";
  put(folder / "scenes/a.toml", "# Rain on\r\n#  a pond. Needs no asset.\r\n" + effect);
  put(folder / "scenes/longer.toml", "#Mist\n# of a kettle.\n# More.\n\n# Not this.\n" + effect);
  put(folder / "scenes/no_comment.toml", effect + "# Below\n");
  put(folder / "scenes/no_scene.toml", "# What is no TOML.\n[");
  EXPECT_THAT(rainref({"list"}).out, HasSubstr("\nScenes\n  scenes/a.toml           Rain on a pond\n"
                                               "  scenes/longer.toml      Mist of a kettle\n"
                                               "  scenes/no_comment.toml\n  scenes/no_scene.toml    What is no TOML\n\n"));
}

TEST_F(List, OfOneEffect) {
  std::filesystem::create_directories(folder / "scenes");
  put(folder / "scenes/drive.toml", "# A drive.\neffect = 'windshield'\n");
  put(folder / "scenes/pond.toml", "# A pond.\neffect = 'puddle'\n");
  put(folder / "scenes/empty.toml", "");
  const Outcome o = rainref({"list", "puddle"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, AllOf(HasSubstr("\nEffects\n  puddle         as-published  raindrops "),
                           HasSubstr("\nScenes\n  scenes/pond.toml  A pond\n\n"), Not(HasSubstr("windshield"))));
  const auto json = nlohmann::json::parse(rainref({"list", "puddle", "--json"}).out);
  EXPECT_EQ(json["effects"].size(), 1u);
  EXPECT_THAT(json["scenes"], ElementsAre("scenes/pond.toml"));
  EXPECT_THAT(json["scene_sentences"], ElementsAre("A pond"));
  std::filesystem::remove_all(folder / "scenes");
  expect_refusal({"list", "pudle"}, 2, EndsWith("found 'pudle'; did you mean 'puddle'?"));
  const std::string own = rainref({"list", "puddle"}).out;
  for (const char* scene : {"\n  puddle/default.toml ", "\n  gallery/puddle.toml "}) EXPECT_THAT(own, HasSubstr(scene));
  EXPECT_THAT(own, Not(HasSubstr("gallery/drive")));
}

TEST_F(List, JsonHasTheSchema) {
  const Outcome o = rainref({"list", "--json"});
  EXPECT_EQ(o.code, 0);
  const auto json = nlohmann::ordered_json::parse(o.out);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("effects", "scenes", "scene_sentences", "presets", "simd_targets", "threads"));
  ASSERT_EQ(json["effects"].size(), 5u);
  const auto& puddle = json["effects"][0];
  EXPECT_EQ(puddle.size(), 3u);
  EXPECT_EQ(puddle["name"], "puddle");
  EXPECT_EQ(puddle["variants"], (std::vector<std::string>{"as-published", "corrected"}));
  EXPECT_EQ(puddle["passes"], (std::vector<std::string>{"raindrops", "wave_step", "surface_hit", "ground_noise", "shade", "display"}));
  EXPECT_GE(json["scenes"].size(), 5u);
  EXPECT_EQ(json["scene_sentences"].size(), json["scenes"].size());
  EXPECT_EQ(json["simd_targets"], simd_targets());
  EXPECT_GE(json["threads"].get<int>(), 1);
}

TEST_F(List, AFolderNamedInNoUtf8IsListed) {
  std::filesystem::create_directories(folder / "scenes");
  put(folder / "scenes/\xff.toml", "");
  const auto json = nlohmann::json::parse(rainref({"list", "--json"}).out);
  EXPECT_THAT(json["scenes"], ElementsAre("scenes/\uFFFD.toml"));
}

TEST_F(Describe, NamesEveryParameterPassAndBuffer) {
  const Outcome o = rainref({"describe", "puddle"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.err, "");
  const Outcome as_json = rainref({"describe", "puddle", "--json"});
  const auto json = nlohmann::json::parse(as_json.out);
  EXPECT_EQ(json["effect"], "puddle");
  EXPECT_GE(json["parameters"].size(), 30u);
  for (const char* of : {"parameters", "passes", "buffers"}) {
    for (const auto& thing : json[of]) {
      EXPECT_THAT(o.out, HasSubstr(thing["name"].get<std::string>()));
      EXPECT_NE(thing["sentence"], "");
    }
  }
  for (const auto& parameter : json["parameters"]) {
    for (const char* key : {"type", "unit", "default", "sentence"}) EXPECT_TRUE(parameter.contains(key)) << parameter;
  }
  for (const auto& buffer : json["buffers"]) EXPECT_NE(buffer["format"], "");
  EXPECT_EQ(json["records"][0]["name"], "Drop");
}

// What most scenes set comes first, what one variant alone has comes last, and the wipers of further panes are not said again.
TEST_F(Describe, BasicKeysComeFirst) {
  const std::string out = rainref({"describe", "windshield"}).out;
  const auto place = [&](const std::string& text) {
    EXPECT_THAT(out, HasSubstr(text));
    return out.find(text);
  };
  const std::size_t basic = place("\n\nBasic keys\n\neffect "), further = place("\nFurther keys\n\n"),
                    published = place("\nKeys of as-published alone\n\n"), passes = place("\nPasses, in the order of execution\n\n");
  for (const char* key : {"\nrun.size ", "\nrain.rate ", "\nwipers.count ", "\ncondensation.on ", "\nscene.image "}) {
    EXPECT_GT(place(key), basic) << key;
    EXPECT_LT(place(key), further) << key;
  }
  EXPECT_GT(place("\nwindshield.neck_time "), further);
  EXPECT_LT(place("\nwindshield.neck_time "), published);
  EXPECT_GT(place("\nwindshield.spawn_rate "), published);
  EXPECT_LT(place("\nwindshield.spawn_rate "), passes);
  EXPECT_THAT(out, Not(HasSubstr("pane_1_wipers.count")));
  EXPECT_GT(place("\npane_1_wipers.*, pane_2_wipers.*\n    The keys of wipers.* once more: `rainref describe windshield pane_1_wipers`.\n"),
            further);
}

TEST_F(Describe, EveryBasicKeyIsOneOfAnEffect) {
  std::set<std::string> keys;
  for (const char* effect : {"puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"}) {
    const auto described = nlohmann::json::parse(rainref({"describe", effect, "--json"}).out);
    for (const auto& parameter : described["parameters"]) keys.insert(parameter["name"].get<std::string>());
  }
  for (const std::string_view key : scene::basic_keys()) EXPECT_TRUE(keys.contains(std::string(key))) << key;
}

TEST_F(Describe, AGroupOfKeysOrOneKey) {
  const Outcome group = rainref({"describe", "windshield", "condensation"});
  EXPECT_EQ(group.code, 0) << group.err;
  EXPECT_THAT(group.out, StartsWith("condensation.on "));
  for (const std::string& line : lines_of(group.out)) EXPECT_TRUE(line.starts_with("condensation.") || line.starts_with("    ")) << line;
  EXPECT_THAT(rainref({"describe", "windshield", "pane_1_wipers"}).out, StartsWith("pane_1_wipers.count "));
  const std::string key = rainref({"describe", "windshield", "rain.rate"}).out;
  EXPECT_THAT(key, StartsWith("rain.rate  real"));
  EXPECT_EQ(lines_of(key).size(), 2u);
  expect_refusal({"describe", "windshield", "condensatoin"}, 2,
                 "windshield: expected a key or the first part of keys, found 'condensatoin'; did you mean 'condensation'?");
  expect_refusal({"describe", "windshield", "mist"}, 2, HasSubstr("found 'mist'; did you mean 'condensation.on'"));
  expect_refusal({"describe", "windshield", "snow"}, 2, EndsWith("found 'snow'"));
  expect_refusal({"describe", "windshield", "rain", "--json"}, 2, "--json: expected no group of keys beside it");
  expect_refusal({"describe", "puddle", "rain", "--layout", "c"}, 2, "--layout: expected no group of keys beside it");
}

TEST_F(Describe, WhatASceneSets) {
  const Outcome o = rainref({"describe", "puddle/default"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, StartsWith("puddle/default: A puddle on a street at night, in rain\n\neffect puddle, variant corrected\n"));
  put(folder / "mine.toml", "# Rain.\neffect = 'puddle'\nvariant = 'corrected'\n[rain]\nrate = 30\n");
  before = folder.names();
  const std::string mine = rainref({"describe", "mine.toml"}).out;
  EXPECT_THAT(mine, AllOf(StartsWith("mine.toml: Rain\n"), ContainsRegex("\nrain.rate  real  30.0  0 to 200 .mm/h.\n"),
                          HasSubstr(" Default: 5."), Not(HasSubstr("puddle.damping")), HasSubstr("\nAll keys: rainref describe puddle\n")));
  const auto json = nlohmann::json::parse(rainref({"describe", "mine.toml", "--json"}).out);
  EXPECT_EQ(json["scene"], "mine.toml");
  EXPECT_EQ(json["sentence"], "Rain");
  EXPECT_EQ(json["values"]["rain.rate"], 30);
  EXPECT_EQ(json["origins"]["rain.rate"], "mine.toml:5:1");
  EXPECT_EQ(json["origins"]["puddle.damping"], "default");
  expect_refusal({"describe", "puddle/defualt"}, 4, HasSubstr("did you mean 'puddle/default.toml'?"));
  expect_refusal({"describe", "mine.toml", "rain"}, 2, "mine.toml: expected an effect beside a group of keys");
  expect_refusal({"describe", "mine.toml", "--layout", "c"}, 2, "mine.toml: expected an effect beside --layout");
}

TEST_F(Describe, ListsOfAPassHaveBindingsOfTheirOwn) {
  const auto layout = [&](const std::string& language) {
    const Outcome o = rainref({"describe", "puddle", "--layout", language, "--pass", "raindrops", "--variant", "corrected"});
    EXPECT_EQ(o.code, 0) << o.err;
    return o.out;
  };
  const std::string glsl = layout("glsl"), hlsl = layout("hlsl"), wgsl = layout("wgsl"), cuda = layout("cuda");
  EXPECT_THAT(
      glsl,
      StartsWith(
          "// Pass raindrops, corrected. Bindings: 0 RainfallUniforms, 1 craters, 2 count_thresholds, 3 shelter, 4 objects, 5 drops.\n"));
  for (const char* line : {"layout(std430, binding = 1) readonly buffer CratersBuffer { Drop craters[]; };\n",
                           "layout(std430, binding = 2) readonly buffer CountThresholdsBuffer { CountThreshold count_thresholds[]; };\n",
                           "layout(std430, binding = 3) readonly buffer ShelterBuffer { ShelterCell shelter[]; };\n",
                           "layout(std430, binding = 4) readonly buffer ObjectsBuffer { Drop objects[]; };\n",
                           "layout(std430, binding = 5) buffer DropsBuffer {\n"})
    EXPECT_THAT(glsl, HasSubstr(line));
  EXPECT_THAT(
      hlsl,
      HasSubstr("StructuredBuffer<CountThreshold> count_thresholds : register(t1);\nStructuredBuffer<ShelterCell> shelter : register(t2);\n"
                "StructuredBuffer<Drop> objects : register(t3);\nRWStructuredBuffer<Drop> drops : register(u0);\n"));
  EXPECT_THAT(wgsl, HasSubstr("@group(0) @binding(2) var<storage, read> count_thresholds : array<CountThreshold>;\n"));
  EXPECT_THAT(cuda, StartsWith("// Pass raindrops, corrected. Reads craters, count_thresholds, shelter, objects; writes drops.\n"));
  // One pass alone prints only what it needs; a buffer that is read and written has two names.
  for (const char* other : {"WaveStepUniforms", "RaindropsUniforms", "ShadeUniforms"}) EXPECT_THAT(glsl, Not(HasSubstr(other)));
  EXPECT_THAT(rainref({"describe", "puddle", "--layout", "glsl", "--pass", "wave_step", "--variant", "as-published"}).out,
              StartsWith("// Pass wave_step, as-published. Bindings: 0 WaveStepUniforms, 1 wave (image), 2 drops, 3 wave_out (image).\n"));
}

TEST_F(Describe, VariantsThatBindTheSameAreOneSection) {
  const std::string display = rainref({"describe", "puddle", "--layout", "glsl", "--pass", "display"}).out;
  EXPECT_THAT(display, StartsWith("// Pass display. Bindings: 0 DisplayUniforms, 1 colour (image), 2 picture (image).\n"));
  EXPECT_EQ(display.find("// Pass", 1), std::string::npos);
  const std::string wave = rainref({"describe", "puddle", "--layout", "glsl", "--pass", "wave_step"}).out;
  EXPECT_THAT(wave, HasSubstr("// Pass wave_step, as-published. "));
  EXPECT_THAT(wave, HasSubstr("// Pass wave_step, corrected. Bindings: 0 WaveStepUniforms, 1 wave (image), 2 drops, 3 shore (image), "));
  EXPECT_EQ(wave.find("struct Drop {"), wave.rfind("struct Drop {")) << "a record is declared once";
}

TEST_F(Describe, EveryLayoutIsPrinted) {
  for (const auto& [language, word] :
       std::vector<std::pair<std::string, std::string>>{{"c", "typedef struct {"},
                                                        {"glsl", "layout(std140, binding = 0) uniform ShadeUniforms {"},
                                                        {"hlsl", "cbuffer ShadeUniforms : register(b0) {"},
                                                        {"wgsl", "struct ShadeUniforms {"},
                                                        {"cuda", "struct ShadeUniforms {"}}) {
    const Outcome o = rainref({"describe", "puddle", "--layout", language});
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.err, "");
    EXPECT_THAT(o.out, HasSubstr(word)) << language;
    for (const char* name : {"Drop", "CountThreshold", "ShelterCell", "RaindropsUniforms", "RainfallUniforms", "WaveStepUniforms",
                             "SurfaceHitUniforms", "GroundNoiseUniforms", "ShadeUniforms", "DisplayUniforms"}) {
      EXPECT_THAT(o.out, HasSubstr(name)) << language;
    }
  }
}

}  // namespace
}  // namespace rainref::cli
