// The manual page and what shells complete, against what the program's help says.
#include <array>
#include <regex>

#include "cli/manual.h"
#include "cli/support.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAreArray;

constexpr std::array verbs{"list",     "describe", "run",    "view",  "hash",     "pack", "diff",
                           "validate", "mutate",   "import", "sweep", "selftest", "demo"};
constexpr std::array sweep_actions{"plan", "run", "status", "collect", "gc", "script"};

class Manual : public CommandLine {
 protected:
  /// The options in a verb's help, "-o" and "--output".
  std::set<std::string> options(const std::string& verb) const {
    std::string help = rainref({verb, "--help"}).out;
    if (verb == "sweep")
      for (const char* action : sweep_actions) help += rainref({verb, action, "--help"}).out;
    std::set<std::string> found;
    std::istringstream lines(help);
    const std::regex names("^  (-[^ ]+)"), one("-{1,2}[A-Za-z][a-z-]*");
    for (std::string line; std::getline(lines, line);) {
      std::smatch start;
      if (!std::regex_search(line, start, names)) continue;
      const std::string said = start[1];
      for (std::sregex_iterator i(said.begin(), said.end(), one), end; i != end; ++i) found.insert(i->str());
    }
    return found;
  }
  /// What bash offers for these words, the last of them begun.
  std::vector<std::string> completed(const std::vector<std::string>& words) const {
    put(folder / "completion", bash_completion());
    std::string list;
    for (const std::string& word : words) list += fmt::format(" '{}'", word);
    put(folder / "ask", fmt::format("source completion\nCOMP_WORDS=(rainref{})\nCOMP_CWORD={}\nPATH='{}':$PATH\n_rainref\nprintf '%s\\n' "
                                    "\"${{COMPREPLY[@]}}\"\n",
                                    list, words.size(), std::filesystem::path(RAINREF_PROGRAM).parent_path().string()));
    std::vector<std::string> found = lines_of(output("bash ask"));
    std::erase(found, "");
    return found;
  }
};

TEST_F(Manual, HasEveryOptionOfEveryVerb) {
  const std::string man = man_page(), zsh = zsh_completion();
  int checked = 0;
  for (const std::string verb : verbs) {
    const std::size_t from = man.find("\n.SS " + verb + "\n");
    ASSERT_NE(from, std::string::npos) << verb;
    const std::string section = man.substr(from + 5, man.find("\n.S", from + 5) - from - 5);
    const std::size_t zsh_from = zsh.find("    (" + verb + ")\n");
    ASSERT_NE(zsh_from, std::string::npos) << verb;
    const std::string zsh_section = zsh.substr(zsh_from, zsh.find(";;", zsh_from) - zsh_from);
    const std::set<std::string> known = options(verb);
    EXPECT_TRUE(known.contains("--help")) << verb;
    for (const std::string& option : known) {
      EXPECT_THAT(section, HasSubstr("\\fB" + std::regex_replace(option, std::regex("-"), "\\-") + "\\fR")) << verb;
      EXPECT_THAT(zsh_section, HasSubstr(option + "[")) << verb;
      ++checked;
    }
    EXPECT_THAT(completed({verb, "-"}), UnorderedElementsAreArray(known)) << verb;
  }
  EXPECT_GT(checked, 60);
}

TEST_F(Manual, ShellsCompleteVerbsWordsScenesAndFiles) {
  EXPECT_EQ(completed({"va"}), std::vector<std::string>{"validate"});
  EXPECT_EQ(completed({"help", "mu"}), std::vector<std::string>{"mutate"});
  EXPECT_EQ(completed({"sweep", "pl"}), std::vector<std::string>{"plan"});
  EXPECT_EQ(completed({"describe", "rain"}), std::vector<std::string>{"rainy_glass"});
  EXPECT_EQ(completed({"run", "x.toml", "--image", "p"}), std::vector<std::string>{"png"});
  EXPECT_EQ(completed({"validate", "--profile", "v"}), std::vector<std::string>{"vulkan"});
  EXPECT_EQ(completed({"hash", "puddle/def"}), std::vector<std::string>{"puddle/default.toml"});
  EXPECT_EQ(completed({"run", "x.toml", "--preset", "st"}), std::vector<std::string>{"storm"});
  EXPECT_THAT(completed({"run", "x.toml", "--frames", ""}), testing::IsEmpty());
  std::filesystem::create_directories(folder / "my_folder");
  put(folder / "my_file.toml", "");
  EXPECT_EQ(completed({"run", "-o", "my_"}), std::vector<std::string>{"my_folder"});
  EXPECT_THAT(completed({"run", "my_"}), UnorderedElementsAreArray({"my_folder", "my_file.toml"}));
}

}  // namespace
}  // namespace rainref::cli
