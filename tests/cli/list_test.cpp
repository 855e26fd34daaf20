// `rainref list` and `rainref describe`.
#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "math/simd_target.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::ElementsAre;
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
  EXPECT_THAT(rainref({"list"}).out, HasSubstr("\n  puddle/default.toml\n"));
  std::filesystem::create_directories(folder / "scenes/deep");
  put(folder / "scenes/deep/mine.toml", "");
  put(folder / "scenes/notes.txt", "");
  const Outcome o = rainref({"list"});
  EXPECT_THAT(o.out, HasSubstr("\nScenes\n  scenes/deep/mine.toml\n\n"));
}

TEST_F(List, JsonHasTheSchema) {
  const Outcome o = rainref({"list", "--json"});
  EXPECT_EQ(o.code, 0);
  const auto json = nlohmann::ordered_json::parse(o.out);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("effects", "scenes", "simd_targets", "threads"));
  ASSERT_EQ(json["effects"].size(), 5u);
  const auto& puddle = json["effects"][0];
  EXPECT_EQ(puddle.size(), 3u);
  EXPECT_EQ(puddle["name"], "puddle");
  EXPECT_EQ(puddle["variants"], (std::vector<std::string>{"as-published", "corrected"}));
  EXPECT_EQ(puddle["passes"], (std::vector<std::string>{"raindrops", "wave_step", "surface_hit", "ground_noise", "shade", "display"}));
  EXPECT_GE(json["scenes"].size(), 5u);
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
