// Parameters are described in text and JSON with the same content.
#include "scene/describe.h"

#include <sstream>

#include <nlohmann/json.hpp>

#include "scene/example_effect.h"

namespace rainref::scene {
namespace {

TEST(Describe, TextIsAlignedColumnsWithNotesBelow) {
  const std::vector<Parameter> table{
      choice("effect", {"puddle", "windshield"}, "", "The effect.").required(),
      real("puddle.damping", "1", 0.95, 0.999, 0.99, "Share kept.").default_for("corrected", 0.995),
      real("puddle.wave_speed", "m/s", 0, 1e300, 0.25, "Speed of long waves.").only("corrected"),
      text("puddle.ground", "a/rather/long/name/of/an/image.png", "Image file."),
      integer("seed", "", 0, 9, 1, "Seed.").only("a").only("b"),
  };
  EXPECT_EQ(describe_text(table),
            "effect             choice   required\n"
            "    The effect. One of 'puddle', 'windshield'.\n"
            "puddle.damping     real     0.99      0.95 to 0.999 [1]\n"
            "    Share kept. Default of variant 'corrected': 0.995.\n"
            "puddle.wave_speed  real     0.25      0 to 1e+300 [m/s]\n"
            "    Speed of long waves. Only in variant 'corrected'.\n"
            "puddle.ground      text     \"a/rather/long/name/of/an/image.png\"\n"
            "    Image file.\n"
            "seed               integer  1         0 to 9\n"
            "    Seed. Only in variant 'a', 'b'.\n");
}

TEST(Describe, TextIsWrappedTo100Columns) {
  std::string sentence;
  for (int i = 0; i < 60; ++i) sentence += i % 7 ? "wörter " : "of ";
  sentence += "end.";
  std::istringstream lines(describe_text(std::vector<Parameter>{boolean("a", true, sentence)}));
  std::string line, joined;
  std::getline(lines, line);
  std::size_t longest = 0;
  while (std::getline(lines, line)) {
    EXPECT_TRUE(line.starts_with("    "));
    std::size_t width = 0;
    for (const char c : line) width += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    EXPECT_LE(width, 100u);
    longest = std::max(longest, width);
    if (!joined.empty()) joined += ' ';
    joined += line.substr(4);
  }
  EXPECT_GT(longest, 93u) << "lines are filled";
  EXPECT_EQ(joined, sentence) << "nothing is lost";
}

TEST(Describe, JsonHasWhatTheTextHas) {
  const auto j = nlohmann::json::parse(describe_json(puddle_parameters()));
  ASSERT_EQ(j.size(), puddle_parameters().size());
  EXPECT_EQ(j[0], nlohmann::json::parse(R"({"name": "puddle.damping", "type": "real", "unit": "1", "minimum": 0.95,
    "maximum": 0.999, "default": 0.99, "sentence": "Share of the height kept from one step to the next.",
    "variant_defaults": {"corrected": 0.995}})"));
  EXPECT_EQ(j[2]["maximum"], nullptr);
  EXPECT_EQ(j[2]["variants"], nlohmann::json({"corrected"}));
  EXPECT_EQ(j[4]["choices"], nlohmann::json({"add", "max"}));
  EXPECT_EQ(j[7]["default"], nlohmann::json({0.0, 1.0, 0.0}));
  EXPECT_FALSE(j[1].contains("choices") || j[1].contains("variants") || j[1].contains("variant_defaults"));
}

TEST(Describe, JsonOfARequiredParameterHasNoDefault) {
  const auto j = nlohmann::json::parse(describe_json(std::vector<Parameter>{text("a", "x", "s").required()}));
  EXPECT_EQ(j[0]["default"], nullptr);
}

}  // namespace
}  // namespace rainref::scene
