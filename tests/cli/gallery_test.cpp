// docs/gallery holds every scene, with commands that rainref takes; docs/gallery.toml holds the parameters that they have.
#include <map>
#include <regex>

#include <CLI/CLI.hpp>

#include "base/temporary_folder.h"
#include "cli/scene_file.h"
#include "cli/support.h"
#include "cli/verbs.h"
#include "effect/inputs.h"
#include "simulation/picture_notes.h"
#include "source_folder.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

struct Section {
  std::string text, picture, parameters, command;  ///< the parameters are those of docs/gallery.toml
};

class Gallery : public testing::Test {
 protected:
  Gallery() {
    const std::string page = contents(folder / "README.md");
    const std::regex heading("(?:^|\n)### ([^\n]+)\n");
    std::vector<std::pair<std::size_t, std::string>> at;
    for (std::sregex_iterator i(page.begin(), page.end(), heading), end; i != end; ++i) at.emplace_back(i->position(), (*i)[1]);
    for (std::size_t k = 0; k < at.size(); ++k) {
      const std::size_t end = k + 1 < at.size() ? at[k + 1].first : page.size();
      Section s;
      s.text = page.substr(at[k].first, end - at[k].first);
      const auto between = [&](const std::string& from, const std::string& to) {
        const std::size_t begin = s.text.find(from);
        return begin == std::string::npos ? ""
                                          : s.text.substr(begin + from.size(), s.text.find(to, begin + from.size()) - begin - from.size());
      };
      s.picture = between("](", ")");
      s.command = between("```sh\n", "\n```");
      EXPECT_TRUE(sections.emplace(at[k].second, s).second) << at[k].second << " is there twice";
    }
    const std::string keys = "\n" + contents(root / "docs/gallery.toml");
    for (auto& [name, section] : sections) {
      const std::string table = "\n[\"" + name + "\"]\n";
      const std::size_t begin = keys.find(table);
      if (begin == std::string::npos) continue;
      section.parameters = keys.substr(begin + table.size(), keys.find("\n[\"", begin + 1) - begin - table.size());
    }
  }
  fs::path root = test::source_folder(), folder = root / "docs/gallery";
  std::map<std::string, Section> sections;
};

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

TEST_F(Gallery, HasEverySceneOnceAndNoOther) {
  std::set<std::string> scenes, shown;
  for (const auto& entry : fs::recursive_directory_iterator(root / "scenes"))
    if (entry.path().extension() == ".toml") scenes.insert(fs::relative(entry.path(), root / "scenes").replace_extension().string());
  for (const auto& [name, section] : sections) shown.insert(name);
  EXPECT_EQ(shown, scenes) << "scripts/gallery makes the page";
  EXPECT_GT(scenes.size(), 30u);
}

/// The scene that a picture of the last frame says of itself.
std::string scene_of(const scene::Config& config) {
  for (const image_io::Note& note :
       simulation::picture_notes(config, {}, static_cast<int>(config.integer("run.frames")) - 1, Image(Format::rgba8, 1, 1)))
    if (note.key == "rainref:scene") return note.value;
  return "";
}

// The command line's own parser takes each command, and the scene that it then loads is that of the keys, in a file at the root.
TEST_F(Gallery, CommandsParseAndTheKeysAreTheirScenes) {
  const TemporaryFolder pasted;
  for (const auto& [name, section] : sections) {
    SCOPED_TRACE(section.command);
    std::vector<std::string> words = words_in(section.command);
    ASSERT_GE(words.size(), 3u);
    EXPECT_EQ(words[0], "rainref");
    EXPECT_EQ(words[1], "run");
    EXPECT_EQ(words[2], "scenes/" + name + ".toml");
    CLI::App app;
    const std::vector<Verb> verbs = add_verbs(app, "");
    std::vector<std::string> reversed(words.rbegin(), words.rend() - 1);
    EXPECT_NO_THROW(app.parse(reversed));
    const auto value = [&](const char* option) {
      const auto at = std::find(words.begin(), words.end(), option);
      return at == words.end() ? std::string() : *(at + 1);
    };
    SceneOptions options;
    options.scene = root / words[2];
    if (const std::string frames = value("--frames"); !frames.empty()) options.overrides.push_back("run.frames=" + frames);
    const scene::Config config = load_scene(options);
    const int frames = static_cast<int>(config.integer("run.frames"));
    if (frames > 1) {
      EXPECT_EQ(value("--first"), std::to_string(frames - 1));
    }
    SceneOptions alone;
    alone.scene = pasted / "pasted.toml";
    alone.overrides.push_back("run.frames=" + std::to_string(frames));
    put(alone.scene, section.parameters);
    const scene::Config of_keys = load_scene(alone);
    EXPECT_EQ(scene_of(of_keys), scene_of(config)) << "scripts/gallery " << name << " makes it anew";
    for (const scene::Config::Entry& e : of_keys.entries()) {
      const auto* file = std::get_if<std::string>(&e.value);
      if (!file || file->empty() || !effect::names_files(e.parameter.key)) continue;
      EXPECT_TRUE(fs::exists(root / *file)) << *file;
    }
  }
}

TEST_F(Gallery, PicturesAreThereAndFitIntoARepository) {
  std::set<std::string> shown{"README.md", "sheet.jpg"}, there;
  for (const auto& [name, section] : sections) shown.insert(section.picture);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    there.insert(entry.path().filename());
    bytes += entry.file_size();
  }
  EXPECT_EQ(there, shown);
  EXPECT_LT(bytes, 6u << 20);
}

}  // namespace
}  // namespace rainref::cli
