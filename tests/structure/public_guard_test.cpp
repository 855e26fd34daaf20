// Every public function that could compute begins by pinning the floating-point state: its caller's may be any.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
const fs::path root = RAINREF_SOURCE_DIR;

std::string text_of(const fs::path& file) { return std::regex_replace(rainref::contents(file), std::regex("//[^\n]*"), ""); }

/// Functions that need no guard: they move, compare and print integers, texts and bytes only.
const std::set<std::string> computes_nothing{"version",
                                             "golden_hash",
                                             "info",
                                             "format_from_name",
                                             "default_settings",
                                             "nearest_name",
                                             "did_you_mean",
                                             "Error::Error",
                                             "SourceLocation::text",
                                             "Image::memory_bytes",
                                             "Image::refuse_to_change",
                                             "BufferView::copy_row",
                                             "Executor::for_tiles",
                                             "Puddle::wave",
                                             "Judgement::Judgement"};

/// Functions that the public headers declare and do not define: "memory_bytes", "Puddle::render".
std::set<std::string> declared(const std::string& header) {
  std::set<std::string> names;
  std::string owner;  // the class that the line is in
  std::istringstream lines(header);
  const std::regex opens("^(?:class|struct) (\\w+)[^;]*\\{"), function("(~?\\w+)\\([^;{]*(?:\\) ?(?:const|noexcept)?(?: = 0)?;|,$)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, opens)) owner = match[1].str() + "::";
    if (line.starts_with("};")) owner.clear();
    const bool is_defined_here = line.find('{') != std::string::npos;
    if (is_defined_here || line.starts_with("    ") || !std::regex_search(line, match, function)) continue;
    const std::string name = match[1];
    const bool is_plain = name.starts_with("~") || line.find("&&) noexcept") != std::string::npos ||
                          line.find("= delete") != std::string::npos || line.find("= 0") != std::string::npos;
    if (!is_plain) names.insert(owner + name);
  }
  return names;
}

/// The bodies of a function's definitions in a source file, from brace to brace.
std::vector<std::string> bodies(const std::string& source, const std::string& name) {
  std::vector<std::string> found;
  const std::regex definition("(^|\n)(?:[\\w:<>&]+ )*" + name + "\\(");
  for (auto i = std::sregex_iterator(source.begin(), source.end(), definition); i != std::sregex_iterator(); ++i) {
    const std::size_t start = static_cast<std::size_t>(i->position()) + static_cast<std::size_t>(i->length());
    const std::size_t brace = source.find_first_of("{;", source.find(')', start));
    if (brace == std::string::npos || source[brace] == ';') continue;
    // Initializers of members have parentheses or braces of one line each; the body's brace ends its line or opens a body of one line.
    const std::size_t line_end = source.find('\n', brace), end = source[line_end - 1] == '}' ? line_end : source.find("\n}", brace);
    found.push_back(source.substr(brace, end - brace));
  }
  return found;
}

/// Whether a body pins the state before anything else, or hands out what is stored, of one of several panes too.
bool is_safe(const std::string& body) {
  return std::regex_search(body, std::regex("^\\{\\s*(if \\(count <= 0\\) return;\\s*)?const FloatingPointGuard \\w+;")) ||
         std::regex_search(body, std::regex("^\\{ return \\w+(->|\\.)(\\w+(\\((pane)?\\))?(->|\\.))*\\w+(\\(\\))?; \\}$"));
}

TEST(PublicGuard, EveryPublicFunctionBeginsWithIt) {
  std::map<std::string, std::vector<std::string>> sources;  // by room
  for (const char* room :
       {"base", "image", "parallel", "puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass", "simulation", "judging"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / "src" / room)) {
      if (entry.path().extension() == ".cpp" && !entry.path().filename().string().starts_with("kernels"))
        sources[room].push_back(text_of(entry.path()));
    }
  }
  int checked = 0;
  for (const auto& entry : fs::directory_iterator(root / "include/rainref")) {
    const std::string stem = entry.path().stem();
    const std::string room = sources.contains(stem) ? stem : stem == "executor" ? "parallel" : stem == "image" ? "image" : "base";
    for (const std::string& name : declared(text_of(entry.path()))) {
      if (computes_nothing.contains(name)) continue;
      std::size_t definitions = 0;
      for (const std::string& source : sources[room]) {
        for (const std::string& body : bodies(source, name)) {
          EXPECT_TRUE(is_safe(body)) << stem << ".h: " << name << body.substr(0, 200);
          ++definitions;
        }
      }
      EXPECT_GE(definitions, 1u) << stem << ".h: " << name << " is defined nowhere in src/" << room;
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

// The checker itself: it must see what it is there to see.
TEST(PublicGuard, TheCheckSeesAFunctionWithout) {
  const std::string header =
      "class Puddle {\n public:\n  Puddle(const Settings& settings,\n         int x);\n  void render(Recorder* recorder = nullptr);\n  int "
      "frame() const;\n  Puddle(Puddle&&) noexcept;\n};\n"
      "double seam(const Image& map);\n";
  EXPECT_EQ(declared(header), (std::set<std::string>{"Puddle::Puddle", "Puddle::render", "Puddle::frame", "seam"}));
  const std::string source =
      "void Puddle::render(Recorder* recorder) {\n  State& s = *state_;\n}\nint Puddle::frame() const { return state_->frame; }\ndouble "
      "seam(const Image& map) {\n  const FloatingPointGuard guard;\n  return 1;\n}\n";
  ASSERT_EQ(bodies(source, "Puddle::render").size(), 1u);
  EXPECT_FALSE(is_safe(bodies(source, "Puddle::render")[0]));
  ASSERT_EQ(bodies(source, "Puddle::frame").size(), 1u);
  EXPECT_TRUE(is_safe(bodies(source, "Puddle::frame")[0]));
  ASSERT_EQ(bodies(source, "seam").size(), 1u);
  EXPECT_TRUE(is_safe(bodies(source, "seam")[0]));
  EXPECT_TRUE(is_safe("{ return state_->pane(pane).height(); }"));
  EXPECT_FALSE(is_safe("{ return state_->at(time).height(); }"));
  EXPECT_FALSE(is_safe("{ return state_->a * 2; }"));
}

}  // namespace
