// `rainref list` and `rainref describe`.
#include <nlohmann/json.hpp>

#include "cli/support.h"
#include "math/simd_target.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

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
  EXPECT_THAT(rainref({"list"}).out, HasSubstr(rainref::test::source_folder() + "/scenes/puddle/default.toml\n"));
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
  ASSERT_EQ(json["effects"].size(), effects().size());
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
    for (const char* name : {"Drop", "CountThreshold", "RaindropsUniforms", "RainfallUniforms", "WaveStepUniforms", "SurfaceHitUniforms",
                             "GroundNoiseUniforms", "ShadeUniforms", "DisplayUniforms"}) {
      EXPECT_THAT(o.out, HasSubstr(name)) << language;
    }
  }
}

}  // namespace
}  // namespace rainref::cli
