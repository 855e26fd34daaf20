// What an artist types leads to the key, and never to another one: guessed_names.txt.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>

#include "cli/support.h"
#include "scene/key_guess.h"
#include "simulation/opened.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

std::vector<scene::Parameter> keys_of(const std::string& effect) {
  const scene::EffectTable& table = simulation::effect_table();
  std::vector<scene::Parameter> keys = scene::scene_parameters(table.find(effect), table);
  std::erase_if(keys, [](const scene::Parameter& p) { return !p.used_by(scene::correct); });
  return keys;
}

/// A section of the file: how many names lead to their key. None may be offered another one.
struct Section {
  std::string title;
  int names = 0, found = 0;
};

TEST(GuessedNames, LeadToTheirKeysAndToNoOther) {
  std::ifstream file(test::source_folder() + "/tests/cli/guessed_names.txt");
  std::vector<Section> sections;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) {
      if (sections.empty() || sections.back().names > 0) sections.emplace_back();
      sections.back().title = line;
      continue;
    }
    std::istringstream words(line);
    std::string effect, name, key;
    words >> effect >> name;
    const std::vector<scene::Parameter> keys = keys_of(effect);
    const std::vector<std::string> offered = scene::keys_meant(name, effect, keys);
    bool is_found = false;
    while (words >> key) {
      const auto is_it = [&](const scene::Parameter& p) { return p.key == key; };
      EXPECT_TRUE(key == "none" || std::any_of(keys.begin(), keys.end(), is_it)) << line;
      is_found |= std::find(offered.begin(), offered.end(), key) != offered.end();
    }
    EXPECT_TRUE(is_found || offered.empty()) << line << ": misled to " << fmt::format("{}", fmt::join(offered, ", "));
    ++sections.back().names;
    sections.back().found += is_found;
  }
  for (const Section& s : sections) std::cout << s.found << " of " << s.names << ": " << s.title << "\n";
  ASSERT_EQ(sections.size(), 3u);
  EXPECT_EQ(sections[0].names, 40);
  EXPECT_GE(sections[0].found, 36);
  EXPECT_GE(sections[1].found, 11);
}

}  // namespace
}  // namespace rainref::cli
