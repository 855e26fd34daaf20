// The examples are ports as they are meant: no seeded bug, and no trace of one. Bugs are edits of them, kept with the tests.
#include <set>

#include "ports/mutant_sources.h"
#include "ports/runner/json_file.h"
#include "ports/support.h"

namespace rainref::ports {
namespace {

std::vector<fs::path> example_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source + "/examples"))
    if (entry.is_regular_file()) files.push_back(entry.path());
  return files;
}
std::vector<port_runner::Mutant> all_mutants() {
  std::vector<port_runner::Mutant> all;
  for (const auto& file : fs::directory_iterator(source + "/tests/ports/mutants"))
    for (port_runner::Mutant& m : port_runner::read_mutants(file.path())) all.push_back(std::move(m));
  return all;
}

TEST(Examples, HaveNoTraceOfASeededBug) {
  const std::vector<fs::path> files = example_files();
  EXPECT_GE(files.size(), 70u);
  for (const fs::path& file : files) {
    const std::string text = contents(file);
    for (const char* word : {"BUG", "eeded bug", "constant_id = 0"}) EXPECT_EQ(text.find(word), std::string::npos) << file << ": " << word;
  }
}

// A shader with a mutant's text in it would be a bug: each replacement is absent where its edit applies, or the edit would do nothing.
TEST(Examples, EachEditOfEachMutantAppliesOnceAndChangesTheFile) {
  std::size_t edits = 0;
  for (const port_runner::Mutant& m : all_mutants()) {
    std::map<std::string, std::string> edited;
    EXPECT_NO_THROW(edited = port_runner::edited_files(m, examples)) << m.id;  // it throws where a text does not occur exactly once
    for (const auto& [file, text] : edited) {
      EXPECT_NE(text, contents(examples + "/" + file)) << m.id;
      EXPECT_TRUE(file.starts_with(m.effect + "/") || file.starts_with("common/")) << m.id << ' ' << file;
    }
    edits += m.edits.size();
  }
  EXPECT_GE(edits, 480u);
}
// docs/notes/devices.md says how many passes of each effect ran there.
TEST(Examples, AreAsManyAsTheNoteOfDevicesSays) {
  const std::string note = contents(source + "/docs/notes/devices.md");
  for (const char* effect : {"puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"}) {
    std::set<std::string> passes;
    const nlohmann::json programs = port_runner::parse_json(examples + "/" + effect + "/bindings.json").at("programs");
    for (const auto& [formula, program] : programs.items()) passes.insert(formula.substr(0, formula.find('/')));
    const std::string words = std::string(effect) + " " + std::to_string(passes.size());
    EXPECT_NE(note.find(words), std::string::npos) << "expected '" << words << "'";
  }
}

// scripts/full/port_mistakes judges them. Two sets, so that what is improved with one can be measured with the other.
TEST(Examples, EachSetOfMistakesIsOfEveryPassAndItsEditsApply) {
  using Pass = std::string;  // "puddle.display.corrected"
  std::set<Pass> passes;
  for (const std::string& effect : packed_effects()) {
    const nlohmann::json programs = port_runner::parse_json(examples + "/" + effect + "/bindings.json").at("programs");
    for (const auto& [formula, program] : programs.items()) passes.insert(formula.substr(0, formula.find('/')));
  }
  std::set<std::pair<Pass, std::string>> kinds[2];
  std::set<std::string> ids;
  for (const int set : {0, 1}) {
    std::set<Pass> covered;
    const nlohmann::json all = port_runner::parse_json(source + "/tests/ports/mistakes/set_" + "ab"[set] + ".json");
    for (const nlohmann::json& m : all.at("mistakes")) {
      const std::string id = m.at("id"), effect = m.at("effect"), pass = effect + "." + std::string(m.at("pass"));
      EXPECT_TRUE(ids.insert(id).second) << id;
      EXPECT_FALSE(std::string(m.at("truth")).empty()) << id;
      covered.insert(pass + "." + std::string(m.at("variant")));
      kinds[set].emplace(pass, m.at("kind"));
      port_runner::Mutant edits{0, effect, m.at("pass"), m.at("variant"), "", "FAIL", "", {}};
      for (const nlohmann::json& e : m.at("edits")) edits.edits.push_back({e.at("file"), e.at("find"), e.at("replace")});
      std::map<std::string, std::string> edited;
      EXPECT_NO_THROW(edited = port_runner::edited_files(edits, examples)) << id;
      EXPECT_FALSE(edited.empty()) << id;
      for (const auto& [file, text] : edited) EXPECT_NE(text, contents(examples + "/" + file)) << id;
    }
    EXPECT_EQ(covered, passes);
  }
  for (const auto& kind : kinds[1]) EXPECT_FALSE(kinds[0].contains(kind)) << kind.first << ": " << kind.second << " is in both sets";
}
TEST(Examples, AnEditThatDoesNotApplyNamesFileIdAndText) {
  const auto message = [](const std::string& find) -> std::string {
    const port_runner::Mutant m{7, "puddle", "display", "corrected", "", "FAIL", "", {{"puddle/display.glsl", find, "x"}}};
    try {
      port_runner::edited_files(m, examples);
    } catch (const port_runner::FileError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(message("no such text"), testing::EndsWith("puddle/display.glsl: mutant 7: expected 'no such text' once, found it 0 times"));
  EXPECT_THAT(message("binding = "), testing::EndsWith("mutant 7: expected 'binding = ' once, found it 3 times"));
}

}  // namespace
}  // namespace rainref::ports
